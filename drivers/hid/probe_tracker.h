#pragma once

#include <chrono>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "drivers/hid/tracker_session.h"

namespace gazeloop::drivers::hid {

/// What a tracker did while it was listened to.
struct TrackerProbe {
    FoundTracker tracker;
    std::optional<std::string> problem;  ///< why it could not be listened to, or ceased
    TrackerFeatures features;
    std::vector<std::string> remarks;
    double seconds = 0.0;
    TrackerSamples::Counts counts;
    std::uint64_t with_gaze = 0;       ///< samples in which at least one eye is valid
    std::optional<double> rate_hz;     ///< samples a second, between the first and the last
    std::optional<std::string> clock;  ///< the verdict on its timestamps
};

/// Opens a tracker, listens for so long or until `stop` says so, and stops it again.
[[nodiscard]] TrackerProbe probe_tracker(const FoundTracker& tracker, const HidOptions& options,
                                         std::chrono::milliseconds listen,
                                         const std::function<bool()>& stop);

}  // namespace gazeloop::drivers::hid
