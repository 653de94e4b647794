#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace gazeloop::time {

/// How a time was obtained. A summary never mixes kinds without saying so.
enum class StampKind : std::uint8_t {
    Unknown,    ///< nobody knows; the value is meaningless and is never shown as 0
    Measured,   ///< read from a clock at the event
    Profile,    ///< a constant from a tracker's or a display's profile was added
    Modelled,   ///< virtual time, or a foreign trace's time line
    Predicted,  ///< announced by the runtime before the event
};

inline constexpr std::size_t kStampKindCount = 5;
inline constexpr std::array<std::string_view, kStampKindCount> kStampKindNames{
    "unknown", "measured", "profile", "modelled", "predicted"};

[[nodiscard]] constexpr std::string_view name(StampKind kind) {
    return kStampKindNames[static_cast<std::size_t>(kind)];
}

/// The less certain of two kinds, which is what a span between two stamps is worth. From the best:
/// measured at the event itself; a profile's constant, measured once on a device of that type; a
/// model's time line, as right as the model. Then: announced before the event, which may have gone
/// otherwise; unknown.
[[nodiscard]] constexpr StampKind weaker(StampKind a, StampKind b) {
    if (a == StampKind::Unknown || b == StampKind::Unknown) {
        return StampKind::Unknown;
    }
    return a < b ? b : a;  // the enumerators above stand in this order
}

/// A point in host time: CLOCK_MONOTONIC, or virtual time in a virtual replay. Nanoseconds.
struct Stamp {
    std::int64_t ns = 0;
    StampKind kind = StampKind::Unknown;

    [[nodiscard]] constexpr bool known() const { return kind != StampKind::Unknown; }
    friend constexpr bool operator==(const Stamp&, const Stamp&) = default;
};

}  // namespace gazeloop::time
