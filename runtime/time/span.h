#pragma once

#include <cstdint>
#include <limits>

#include "runtime/time/stamp.h"

namespace gazeloop::time {

/// A time between two stamps, or a sum of such. Nanoseconds, may be negative.
struct Span {
    std::int64_t ns = 0;  ///< meaningless if unknown
    StampKind kind = StampKind::Unknown;

    [[nodiscard]] constexpr bool known() const { return kind != StampKind::Unknown; }
    friend constexpr bool operator==(const Span&, const Span&) = default;
};

/// Clamped, because stamps that a broken clock or a damaged file put 292 years apart must not wrap
/// around.
[[nodiscard]] constexpr std::int64_t saturated(__int128 ns) {
    constexpr __int128 kMin = std::numeric_limits<std::int64_t>::min();
    constexpr __int128 kMax = std::numeric_limits<std::int64_t>::max();
    return static_cast<std::int64_t>(ns < kMin ? kMin : ns > kMax ? kMax : ns);
}

/// Between two times on one clock, each any number of nanoseconds; clamped.
[[nodiscard]] constexpr std::int64_t elapsed_ns(std::int64_t from_ns, std::int64_t to_ns) {
    return saturated(static_cast<__int128>(to_ns) - from_ns);
}

/// As certain as the less certain of the two ends.
[[nodiscard]] constexpr Span between(const Stamp& from, const Stamp& to) {
    const StampKind kind = weaker(from.kind, to.kind);
    if (kind == StampKind::Unknown) {
        return {};
    }
    return {elapsed_ns(from.ns, to.ns), kind};
}

/// Whether both are known and the second is the earlier one.
[[nodiscard]] constexpr bool goes_back(const Stamp& before, const Stamp& now) {
    return before.known() && now.known() && now.ns < before.ns;
}

}  // namespace gazeloop::time
