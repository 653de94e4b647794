#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/gaze/gaze_sample.h"
#include "runtime/time/clock_fit.h"
#include "runtime/time/tick_counter.h"

namespace gazeloop::drivers {

/// From exposure to the host's read.
struct TrackerDelay {
    std::int64_t least_ns = 0;        ///< from the profile: when nothing is in the way
    std::int64_t uncertainty_ns = 0;  ///< of that, either way
    /// From the bus: how often the host asks for samples. 0 where they come by themselves: from a
    /// virtual device, or from a bulk endpoint (the PSVR2's) with requests pending. The controller
    /// asks such an endpoint again and again, in whatever bus time is left, not at fixed times.
    std::int64_t polling_ns = 0;
};

/// "clock: good, within 0.12 ms, skew +48 ppm".
[[nodiscard]] std::string describe(const time::ClockFit& fit);

/// Gives the samples of one tracker their times.
class SampleClock {
  public:
    /// `counter` is the tracker's, before its first reading.
    SampleClock(const time::TickCounter& counter, const TrackerDelay& delay)
        : counter_(counter), delay_(delay), fit_(delay.polling_ns) {}

    /// Sets device_ns and arrived of a sample with that timestamp; to be called in the order of
    /// arrival. Where the clock's verdict allows, also ready (by the fitted clock), sampled (the
    /// profile's delay before that, kind Profile) and the uncertainty. It covers the clock, the
    /// delay and the polling.
    void stamp(std::uint64_t ticks, std::int64_t arrived_ns, gaze::GazeSample& sample);

    /// Another report of the same device, without a timestamp of this clock: it waited in the same
    /// queue.
    void pass(std::int64_t arrived_ns);

    /// How many reports are missing before the sample stamped last, where that is certain: after a
    /// backlog as long as the kernel's queue a gap is a loss. Any other gap may be a tracker that
    /// sends nothing while it sees no eyes.
    [[nodiscard]] std::uint64_t lost_before_last() const { return lost_; }

    [[nodiscard]] const time::ClockFit& fit() const { return fit_; }

    /// One line where the verdict is another than the one reported last, or the clock was set. A
    /// restless clock reports its verdict, not each step. The reason for an unknown age is reported
    /// after `kReadingsToTell` samples. Apart from that, at most one line per `kCalm_ns`; a change
    /// that still holds by then is reported then.
    [[nodiscard]] std::optional<std::string> take_change();

    static constexpr std::uint64_t kReadingsToTell = 100;
    static constexpr std::int64_t kCalm_ns = 10'000'000'000;

  private:
    void count_backlog(std::int64_t arrived_ns);

    time::TickCounter counter_;
    TrackerDelay delay_;
    time::ClockFit fit_;
    std::optional<std::int64_t> last_device_ns_;
    std::optional<std::int64_t> last_stamped_ns_;  ///< when the sample before had arrived
    std::int64_t last_arrived_ns_ = 0;
    std::uint64_t queued_in_a_row_ = 0;
    std::uint64_t backlog_ = 0;  ///< the longest of these since the sample stamped last
    std::uint64_t lost_ = 0;
    std::uint64_t unusable_in_a_row_ = 0;
    std::optional<std::int64_t> told_ns_;
    std::optional<time::ClockVerdict> told_verdict_;
    std::uint64_t told_steps_ = 0;
};

}  // namespace gazeloop::drivers
