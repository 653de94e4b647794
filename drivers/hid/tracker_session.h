#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <string>
#include <vector>

#include "drivers/device/tracker_device.h"
#include "drivers/device/tracker_probe.h"
#include "drivers/hid/find_trackers.h"
#include "drivers/hid/hidraw_device.h"
#include "drivers/hid/tracker_samples.h"
#include "runtime/time/clock.h"

namespace gazeloop::drivers::hid {

/// What the user configured about trackers of this kind.
struct HidOptions {
    std::string path;  ///< only the device at this node or link; empty: the first that there is
    TrackerDelay delay;
    ScreenGeometry geometry;  ///< what is not 0 counts instead of what the device states
};

/// An eye tracker that was opened and asked to send. It is asked again when no gaze comes for a
/// second, whether or not it took the request before (one that boots or is being set up may refuse
/// it). What it states of itself is read again when that may have changed: see ask_again(). The
/// destructor stops the tracker, unless another program of ours reads it.
class TrackerSession final : public TrackerDevice {
  public:
    /// Calls `stop` after each of up to 14 requests, because a device may take seconds for one;
    /// also when the requests are repeated later. Errors: NoDevice if it cannot be opened, BadInput
    /// if its descriptor cannot be used, Interrupted if `stop` said so (the device has not been
    /// started then).
    [[nodiscard]] static Expected<TrackerSession> open(const FoundTracker& tracker,
                                                       const HidOptions& options,
                                                       const StopRequested& stop);
    TrackerSession(TrackerSession&&) = default;
    TrackerSession(const TrackerSession&) = delete;
    TrackerSession& operator=(TrackerSession&&) = delete;
    TrackerSession& operator=(const TrackerSession&) = delete;
    ~TrackerSession() override;

    [[nodiscard]] const TrackerFeatures& features() const { return features_; }
    [[nodiscard]] const std::string& text() const override { return text_; }
    [[nodiscard]] const std::vector<std::string>& remarks() const override { return remarks_; }
    [[nodiscard]] TrackerFacts facts() const override;
    [[nodiscard]] Expected<void> read(std::chrono::milliseconds longest, DeviceFeed& feed) override;
    [[nodiscard]] TrackerCounts counts() const override { return samples_.counts(); }
    [[nodiscard]] const time::ClockFit* clock() const override { return samples_.clock(); }

  private:
    TrackerSession(std::string text, HidrawDevice device, std::vector<FeatureReport> reports,
                   const EyeTrackerLayout& layout, const HidOptions& options,
                   StopRequested stopped);
    void ask_again(std::int64_t now_ns, DeviceFeed& feed);
    void read_features_again(DeviceFeed& feed);
    [[nodiscard]] ScreenGeometry geometry() const;

    std::string text_;
    HidrawDevice device_;
    EyeTrackerLayout layout_;
    ScreenGeometry configured_;
    StopRequested stopped_;
    std::vector<FeatureReport> reports_;  ///< as they could be read last
    TrackerFeatures features_;            ///< in them
    std::vector<std::string> reported_;   ///< of the features
    std::vector<std::string> remarks_;
    /// The reports that start and stop it; empty where it has no control.
    std::vector<std::uint8_t> start_;
    std::vector<std::uint8_t> stop_;
    bool refused_ = false;  ///< it has not taken a request to start yet
    bool ready_ = false;    ///< it has become so since its features were read
    // When it was last asked to send, sent tracking data, and sent valid gaze.
    std::int64_t asked_ns_ = time::monotonic_ns();
    std::int64_t tracked_ns_ = asked_ns_;
    std::int64_t gaze_ns_ = asked_ns_;
    TrackerSamples samples_;
};

/// Opens the tracker that the options ask for; null where none is plugged in, or what is at the
/// path is none. Errors: as open(), and NoDevice where there is nothing at the path.
[[nodiscard]] Expected<std::unique_ptr<TrackerDevice>> open_tracker(const HidOptions& options,
                                                                    const StopRequested& stop);

inline constexpr TrackerSupport kSupport{
    "hid", "HID usage page 0x12: verified with emulated devices, not tried on hardware"};

/// Listens to each tracker that is plugged in.
[[nodiscard]] std::vector<TrackerProbe> probe_trackers(const HidOptions& options,
                                                       std::chrono::milliseconds listen,
                                                       const StopRequested& stop);

}  // namespace gazeloop::drivers::hid
