#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string_view>
#include <variant>
#include <vector>

#include "drivers/hid/eye_tracker_layout.h"

namespace gazeloop::drivers::hid {

/// Configuration Status, usage 0x301.
enum class TrackerStatus : std::uint8_t {
    Unknown = 0,
    Ready = 1,
    Configuring = 2,
    ScreenSetupNeeded = 3,
    UserCalibrationNeeded = 4,
};
/// What the status means and, where the user can do something, what.
[[nodiscard]] std::string_view text_of(TrackerStatus status);

struct StatusReport {
    std::optional<TrackerStatus> status;
    std::optional<std::uint32_t> sampling_hz;

    friend bool operator==(const StatusReport&, const StatusReport&) = default;
};

/// One report of tracking data. Positions lie on the screen or in front of it, in metres. Origin at
/// the screen's top left corner, +X right as the viewer sees it, +Y down, +Z from the screen
/// towards the viewer. (The usage page leaves the origin open; top left is what its drivers do.)
/// What the device does not say, or marks as no data, is absent.
struct TrackingReport {
    std::uint8_t report_id = 0;
    std::optional<std::uint64_t> ticks;  ///< of the timestamp field, in two's complement
    std::optional<glm::dvec2> gaze_m;
    gaze::PerEye<std::optional<glm::dvec3>> eye_m;
    StatusReport status;     ///< where it stands in the same report
    bool truncated = false;  ///< shorter than the descriptor says
};

/// A report of something else: other keys, an unknown id, or no bytes at all.
struct OtherReport {};

using InputReport = std::variant<OtherReport, TrackingReport, StatusReport>;

/// `bytes` as they were read: with the id first where the device numbers its reports.
[[nodiscard]] InputReport decode_input(const EyeTrackerLayout& layout,
                                       std::span<const std::uint8_t> bytes);

/// A length that the device states and that is impossible.
struct ImplausibleLength {
    std::string_view of;  ///< "its screen's width"
    double metres = 0.0;
};

/// What the device said of itself. Zero and no data are absent. So are impossible lengths: those
/// below 1 cm or above 10 m, unless a common factor of 1000 makes them plausible.
struct TrackerFeatures {
    std::optional<std::uint32_t> quality;  ///< on a scale of the device's own
    std::optional<double> minimum_distance_m;
    std::optional<double> optimum_distance_m;
    std::optional<double> maximum_distance_m;
    std::optional<double> maximum_width_m;
    std::optional<double> maximum_height_m;
    /// The factor that makes most of the distances and sizes above plausible, already applied: 1,
    /// 1000 or 0.001. Some devices are off by that factor from the unit they state.
    double capability_correction = 1.0;
    /// As in the EDID of the display that it is set up for.
    std::optional<std::uint32_t> display_manufacturer;
    std::optional<std::uint32_t> display_product;
    std::optional<std::uint32_t> display_serial;
    std::optional<double> screen_width_m;
    std::optional<double> screen_height_m;
    double screen_correction = 1.0;              ///< the same of the screen
    std::vector<ImplausibleLength> implausible;  ///< absent above; as stated
    StatusReport status;
};

/// A feature report as it was read, with its id first (0 where the device does not number them).
struct FeatureReport {
    std::uint8_t id = 0;
    std::vector<std::uint8_t> bytes;
};

/// Features of reports that could not be read are absent.
[[nodiscard]] TrackerFeatures decode_features(const EyeTrackerLayout& layout,
                                              std::span<const FeatureReport> reports);

/// What a tracker is asked to send (Device Mode Request, usage 0x400); 0 stops it.
enum TrackerMode : std::uint8_t {
    kModeStop = 0,
    kModeGaze = 1,
    kModeEyePosition = 2,
};

/// The feature report that asks for these modes, id first; none where the device has no control.
[[nodiscard]] std::optional<std::vector<std::uint8_t>> encode_mode_request(
    const EyeTrackerLayout& layout, std::uint8_t modes);

}  // namespace gazeloop::drivers::hid
