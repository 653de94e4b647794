#pragma once

#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "drivers/device/sample_clock.h"
#include "drivers/device/tracker_device.h"
#include "drivers/hid/eye_tracker_reports.h"
#include "drivers/hid/screen_gaze.h"

namespace gazeloop::drivers::hid {

/// Makes samples of a tracker's input reports, in the order of arrival. Allocates only where it has
/// a change to report.
class TrackerSamples {
  public:
    /// `status` is what the tracker said of itself before: no change.
    TrackerSamples(EyeTrackerLayout layout, const ScreenGeometry& geometry,
                   const TrackerDelay& delay, std::optional<TrackerStatus> status = {});

    /// What the tracker has said of itself since. A status counts only while no report has stated
    /// one: reports are newer.
    void learn(const ScreenGeometry& geometry, std::optional<TrackerStatus> status);

    /// The sample of a report that had arrived by `arrived_ns`, without its number. None where the
    /// report is of something else, or of the eyes' positions alone.
    [[nodiscard]] std::optional<gaze::GazeSample> take(std::span<const std::uint8_t> report,
                                                       std::int64_t arrived_ns);
    /// Whether the last report was of gaze or eyes, not of something else.
    [[nodiscard]] bool tracked_last() const { return tracked_last_; }
    /// As the tracker stated it last.
    [[nodiscard]] std::optional<TrackerStatus> status() const { return status_; }
    /// Reports that are missing before the last sample.
    [[nodiscard]] std::uint64_t lost_before_last() const { return lost_before_last_; }

    /// A line about what changed: the device's status, its clock.
    [[nodiscard]] std::optional<std::string> take_change();

    /// Reports that were cut short are damaged, and samples nevertheless.
    [[nodiscard]] const TrackerCounts& counts() const { return counts_; }
    /// The clock of the report with a timestamp that came last; null before the first, and for a
    /// tracker without timestamps.
    [[nodiscard]] const time::ClockFit* clock() const;

  private:
    void note(std::optional<TrackerStatus> status);
    void note_reported(const StatusReport& report);
    /// Tells all clocks but this one of a report that they do not stamp.
    void pass_clocks(std::int64_t arrived_ns, std::optional<std::size_t> but = {});

    EyeTrackerLayout layout_;
    ScreenGeometry geometry_;
    /// By the index of the tracking report; none for those without a timestamp.
    std::vector<std::optional<SampleClock>> clocks_;
    std::optional<std::size_t> last_clock_;
    std::uint64_t lost_before_last_ = 0;
    /// Where the eyes were last seen, for trackers that report them apart from the gaze.
    struct SeenEyes {
        std::int64_t arrived_ns = std::numeric_limits<std::int64_t>::min() / 2;
        gaze::PerEye<std::optional<glm::dvec3>> eye_m;
    };
    /// Heads move by centimetres per second: a few millimetres in that time.
    static constexpr std::int64_t kEyesHoldNs = 200'000'000;

    SeenEyes eyes_;
    std::optional<TrackerStatus> status_;
    bool status_changed_ = false;
    bool status_reported_ = false;
    bool tracked_last_ = false;
    TrackerCounts counts_;
};

}  // namespace gazeloop::drivers::hid
