#pragma once

#include <chrono>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/device/found_device.h"
#include "drivers/device/tracker_device.h"
#include "runtime/gaze/anatomy.h"

namespace gazeloop::drivers {

/// A kind of tracker, for people and programs.
struct TrackerSupport {
    std::string_view source;    ///< what --gaze calls it
    std::string_view verified;  ///< how well it is known to work
};

/// What a tracker did while it was listened to.
struct TrackerProbe {
    TrackerSupport support;
    FoundDevice device;
    std::optional<std::string> problem;  ///< why it could not be listened to, or ceased
    std::optional<std::string> silence;  ///< that it gave no sample, though it was listened to
    TrackerFacts facts;
    std::vector<std::string> remarks;  ///< of the device, when it was opened and later
    double seconds = 0.0;
    TrackerCounts counts;
    std::uint64_t with_gaze = 0;          ///< samples in which at least one eye is valid
    std::optional<double> rate_hz;        ///< samples per second, from the first to the last
    PupilsMm pupils_mm;                   ///< as they were last seen
    std::optional<time::ClockFit> clock;  ///< of its timestamps, where it sends any
    /// What its directions say of the eyes; none: no gaze came.
    std::optional<gaze::Anatomy> anatomy;
};

/// Opens a tracker, listens for this long or until `stop` says so, and stops it again. Listens for
/// longer while it may still answer what it was asked.
[[nodiscard]] TrackerProbe probe_tracker(const TrackerSupport& support, const FoundDevice& device,
                                         const OpenTracker& open, std::chrono::milliseconds listen,
                                         const StopRequested& stop);

}  // namespace gazeloop::drivers
