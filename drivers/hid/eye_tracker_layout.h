#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drivers/hid/report_value.h"
#include "runtime/error.h"
#include "runtime/gaze/eye.h"
#include "runtime/time/tick_range.h"

namespace gazeloop::drivers::hid {

/// A timestamp: one number, or an array of its bytes, least significant first.
///
/// Its counter begins anew after the field's logical maximum, at the logical minimum: of a field of
/// 32 bits from 0 to 2^31 - 1 it has 31 bits, from 0 to 999,999 a million numbers, from -2^31 or
/// -2^31 + 1 to 2^31 - 1 it has 32 and a sign. That is what a logical range says
/// (HID 1.11, 6.2.2.7: what the field may hold). The width of the field counts where it states no
/// range (maximum at or below the minimum, or none) or one that does not fit in it, and for an
/// array, whose range is that of its parts. A counter that goes on beyond its stated range is as
/// wide as its field after all (time::TickCounter).
struct TimestampField {
    std::uint32_t bit_offset = 0;
    std::uint32_t bits = 0;   ///< 1 .. 64
    time::TickRange range;    ///< inside held_in()
    double tick_ns = 1000.0;  ///< > 0

    /// Of all numbers that the field can hold.
    [[nodiscard]] time::TickRange held_in() const {
        return range.least < 0 ? time::TickRange::of_signed_bits(bits)
                               : time::TickRange::of_bits(bits);
    }
    /// Its number in a report, in two's complement; none where the payload ends before.
    [[nodiscard]] std::optional<std::uint64_t> ticks(std::span<const std::uint8_t> payload) const;

    friend bool operator==(const TimestampField&, const TimestampField&) = default;
};

using PositionFields = std::array<std::optional<ReportValue>, 3>;  ///< x, y, z

/// An input report that carries tracking data; what it lacks is absent.
struct TrackingLayout {
    std::uint8_t report_id = 0;
    std::optional<TimestampField> timestamp;
    PositionFields gaze_point;  ///< z is never used: the point lies on the screen
    gaze::PerEye<PositionFields> eye_position;

    [[nodiscard]] bool has_gaze() const { return gaze_point[0] && gaze_point[1]; }
    [[nodiscard]] bool has_eye(gaze::Eye eye) const {
        const PositionFields& fields = eye_position[gaze::index(eye)];
        return fields[0] && fields[1] && fields[2];
    }
};

struct StatusLayout {
    std::optional<ReportValue> status;
    std::optional<ReportValue> sampling_hz;
};

/// What an eye tracker's reports hold, and where.
struct EyeTrackerLayout {
    bool numbered = false;                 ///< reports begin with their id
    std::vector<ReportSize> reports;       ///< all of the device
    std::vector<TrackingLayout> tracking;  ///< one for each report that has gaze or eyes
    StatusLayout status_input;
    StatusLayout status_feature;

    // Features.
    std::optional<ReportValue> quality;
    std::optional<ReportValue> minimum_distance;
    std::optional<ReportValue> optimum_distance;
    std::optional<ReportValue> maximum_distance;
    std::optional<ReportValue> maximum_width;
    std::optional<ReportValue> maximum_height;
    std::optional<ReportValue> display_manufacturer;
    std::optional<ReportValue> display_product;
    std::optional<ReportValue> display_serial;
    std::optional<ReportValue> screen_width;
    std::optional<ReportValue> screen_height;
    std::optional<ReportValue> mode_request;

    /// The feature reports that something above is read from, by id: those without which gaze is
    /// no good first (the screen's size, the status).
    [[nodiscard]] std::vector<std::uint8_t> feature_ids() const;
};

/// Whether the descriptor has an application collection of an eye tracker.
[[nodiscard]] bool describes_eye_tracker(const ReportDescriptor& descriptor);

/// Finds an eye tracker's numbers by usage, unit, exponent and size, wherever they stand: nothing
/// is concluded from their place, from report ids or from the Constant flag. A position is of what
/// its innermost collection with the usage Gaze Point, Left or Right Eye Position says. Where the
/// field's own usage is one of these, that counts.
///
/// Errors (BadInput): no eye tracker collection, or no report that has a gaze point.
[[nodiscard]] Expected<EyeTrackerLayout> find_eye_tracker(const ReportDescriptor& descriptor);

}  // namespace gazeloop::drivers::hid
