#pragma once

#include <optional>
#include <string>
#include <vector>

#include "drivers/hid/find_trackers.h"
#include "drivers/hid/hidraw_device.h"
#include "drivers/hid/tracker_samples.h"

namespace gazeloop::drivers::hid {

/// What the user configured about trackers of this kind.
struct HidOptions {
    std::string path;  ///< only the device at this node; empty: the first that there is
    TrackerDelay delay;
    ScreenGeometry geometry;  ///< what is not 0 counts instead of what the device states
};

/// An eye tracker that was opened and asked to send. Stops it when it goes.
class TrackerSession {
  public:
    /// Errors: NoDevice where it cannot be opened, BadInput where its descriptor is no good.
    [[nodiscard]] static Expected<TrackerSession> open(const FoundTracker& tracker,
                                                       const HidOptions& options);
    TrackerSession(TrackerSession&&) = default;
    TrackerSession(const TrackerSession&) = delete;
    TrackerSession& operator=(TrackerSession&&) = delete;
    TrackerSession& operator=(const TrackerSession&) = delete;
    ~TrackerSession();

    [[nodiscard]] const TrackerFeatures& features() const { return features_; }
    /// What the device stated, and what keeps gaze from coming, one line each.
    [[nodiscard]] const std::vector<std::string>& remarks() const { return remarks_; }
    [[nodiscard]] TrackerSamples& samples() { return samples_; }
    [[nodiscard]] HidrawDevice& device() { return device_; }

  private:
    TrackerSession(HidrawDevice device, const EyeTrackerLayout& layout, const HidOptions& options);
    void describe(const EyeTrackerLayout& layout, const ScreenGeometry& geometry);

    HidrawDevice device_;
    TrackerFeatures features_;
    std::vector<std::string> remarks_;
    std::vector<std::uint8_t> stop_;  ///< the report that stops it; empty where it has no control
    TrackerSamples samples_;
};

/// The tracker that the options ask for among those found; null where it is not there.
[[nodiscard]] const FoundTracker* chosen(const std::vector<FoundTracker>& trackers,
                                         const HidOptions& options);

}  // namespace gazeloop::drivers::hid
