#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/gaze/gaze_sample.h"
#include "runtime/latency/clock_fit.h"
#include "runtime/latency/tick_counter.h"

namespace gazeloop::drivers {

/// From a tracker's profile: from exposure to the host's read, when nothing is in the way.
struct TrackerDelay {
    std::int64_t least_ns = 0;
    std::int64_t uncertainty_ns = 0;  ///< either way
};

/// "clock: good, within 0.12 ms, skew +48 ppm".
[[nodiscard]] std::string describe(const latency::ClockFit& fit);

/// Gives the samples of one tracker their times.
class SampleClock {
  public:
    /// The tracker's counter has `bits` (1 to 64) and ticks of `tick_ns` (> 0).
    SampleClock(std::uint32_t bits, double tick_ns, const TrackerDelay& delay)
        : counter_(bits, tick_ns), delay_(delay) {}

    /// Sets the times of a sample with that timestamp, in the order of arrival: device_ns, arrived,
    /// and, where the clock's verdict allows, ready (by the fitted clock), sampled (the profile's
    /// delay before that, kind Profile) and the uncertainty of both together.
    void stamp(std::uint64_t ticks, std::int64_t arrived_ns, gaze::GazeSample& sample);

    /// How many reports are missing before the sample stamped last, where that is certain: after a
    /// backlog as long as the kernel's queue a gap is a loss. Any other gap may be a tracker that
    /// sends nothing while it sees no eyes.
    [[nodiscard]] std::uint64_t lost_before_last() const { return lost_; }

    [[nodiscard]] const latency::ClockFit& fit() const { return fit_; }

    /// One line where the verdict is another than at the last call, or the clock was set.
    [[nodiscard]] std::optional<std::string> take_change();

  private:
    latency::TickCounter counter_;
    TrackerDelay delay_;
    latency::ClockFit fit_;
    std::optional<std::int64_t> last_device_ns_;
    std::int64_t last_arrived_ns_ = 0;
    std::uint64_t queued_in_a_row_ = 0;
    std::uint64_t lost_ = 0;
    std::optional<latency::ClockVerdict> told_verdict_;
    std::uint64_t told_steps_ = 0;
};

}  // namespace gazeloop::drivers
