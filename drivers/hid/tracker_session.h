#pragma once

#include <chrono>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/device/tracker_device.h"
#include "drivers/device/tracker_probe.h"
#include "drivers/hid/feature_requests.h"
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
///
/// All requests are made while its reports are read (feature_requests.h). A request that was not
/// answered is told; such a feature report is asked for no more, and such a start seldom.
class TrackerSession final : public TrackerDevice {
  public:
    /// Waits up to kPatience for what the tracker states; what comes later is told by read(). Asks
    /// `stop` before each of up to 14 requests, on another thread, also when the requests are
    /// repeated later. Errors: NoDevice if it cannot be opened, BadInput if its descriptor cannot
    /// be used, Interrupted if `stop` said so (after the request that is being made, if any).
    [[nodiscard]] static Expected<TrackerSession> open(const FoundTracker& tracker,
                                                       const HidOptions& options,
                                                       const StopRequested& stop);
    TrackerSession(TrackerSession&&) = default;
    TrackerSession(const TrackerSession&) = delete;
    TrackerSession& operator=(TrackerSession&&) = delete;
    TrackerSession& operator=(const TrackerSession&) = delete;
    ~TrackerSession() override;

    static constexpr std::chrono::milliseconds kPatience{1000};

    [[nodiscard]] const TrackerFeatures& features() const { return features_; }
    [[nodiscard]] const std::string& text() const override { return text_; }
    [[nodiscard]] const std::vector<std::string>& remarks() const override { return remarks_; }
    [[nodiscard]] TrackerFacts facts() const override;
    [[nodiscard]] Expected<void> read(std::chrono::milliseconds longest, DeviceFeed& feed) override;
    [[nodiscard]] TrackerCounts counts() const override { return samples_.counts(); }
    [[nodiscard]] bool asking() const override { return asking_; }
    [[nodiscard]] std::string_view why_silent() const override;
    [[nodiscard]] const time::ClockFit* clock() const override { return samples_.clock(); }

  private:
    TrackerSession(std::string text, HidrawDevice device, const EyeTrackerLayout& layout,
                   const HidOptions& options, StopRequested stopped);
    void ask(bool start, bool features);
    void ask_again(std::int64_t now_ns);
    /// Takes what was answered; gives a line for each thing that is new.
    [[nodiscard]] std::vector<std::string> take_answers();
    void take_start(const FeatureRequests::Outcome& outcome, std::vector<std::string>& lines);
    void learn_features(std::vector<std::string>& lines);
    [[nodiscard]] ScreenGeometry geometry() const;

    std::string text_;
    std::unique_ptr<HidrawDevice> device_;
    EyeTrackerLayout layout_;
    ScreenGeometry configured_;
    std::vector<FeatureReport> reports_;       ///< as they could be read last
    std::vector<std::uint8_t> unanswered_;     ///< ids of those that are asked for no more
    TrackerFeatures features_;                 ///< in reports_
    std::vector<std::string> reported_;        ///< of the features
    std::optional<std::string> told_problem_;  ///< of the geometry, once all was asked for
    std::vector<std::string> remarks_;
    /// The reports that start and stop it; empty where it has no control.
    std::vector<std::uint8_t> start_;
    std::vector<std::uint8_t> stop_;
    bool started_ = false;     ///< it was asked to start, and may have
    bool refused_ = false;     ///< it has not taken a request to start yet
    bool ready_ = false;       ///< it has become so since its features were read
    bool read_again_ = false;  ///< its features, once the requests before are made
    bool asking_ = false;      ///< requests are being made, or their outcome was not taken yet
    // When it was last asked, sent tracking data, and sent valid gaze.
    std::int64_t asked_ns_ = time::monotonic_ns();
    std::int64_t tracked_ns_ = asked_ns_;
    std::int64_t gaze_ns_ = asked_ns_;
    std::int64_t ask_after_ns_;  ///< no gaze for so long
    TrackerSamples samples_;
    std::unique_ptr<FeatureRequests> requests_;  ///< of device_, so that it ends before that
};

/// Opens the tracker that the options ask for; null where none is plugged in, or what is at the
/// path is none. Errors: as open(), and NoDevice where there is nothing at the path.
[[nodiscard]] Expected<std::unique_ptr<TrackerDevice>> open_tracker(const HidOptions& options,
                                                                    const StopRequested& stop);

inline constexpr TrackerSupport kSupport{
    "hid", "HID usage page 0x12: verified with emulated devices, not tried on hardware"};

/// Listens to these trackers, to all of them at once: one that does not answer holds up no other.
/// `stop` is asked by several threads.
[[nodiscard]] std::vector<TrackerProbe> probe_trackers(const std::vector<FoundTracker>& trackers,
                                                       const HidOptions& options,
                                                       std::chrono::milliseconds listen,
                                                       const StopRequested& stop);

}  // namespace gazeloop::drivers::hid
