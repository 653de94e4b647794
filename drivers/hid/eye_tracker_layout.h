#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <vector>

#include "drivers/hid/report_value.h"
#include "runtime/error.h"
#include "runtime/gaze/eye.h"

namespace gazeloop::drivers::hid {

/// A timestamp: one number, or an array of its bytes, least significant first.
struct TimestampField {
    std::uint32_t bit_offset = 0;
    std::uint32_t bits = 0;   ///< 1 .. 64; the counter wraps after so many
    double tick_ns = 1000.0;  ///< > 0

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

    /// The feature reports that something above is read from, by id.
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
