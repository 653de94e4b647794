#pragma once

#include <cstdint>

namespace gazeloop::time {

/// How coarse a device's timestamps are, if its clock's tick is no longer than its sample period.
/// (With a longer tick, several samples in a row bear the same timestamp: ClockFit sees that.)
///
/// The tick T is the greatest common divisor of the increments. If T is below the least increment,
/// there is no doubt. If it **is** the least, increments of T and, now and then, 2 T can have two
/// causes:
/// - regular samples every T, of which some are lost. The timestamps of the others are exact;
/// - samples every (1 + f) T, 0 < f < 1, of a clock that counts in T and slips once in 1 / f of
///   them. Its timestamps are up to T too early.
///
/// The arrivals can tell, because they know nothing of the clock's ticks. Let e be the advance of a
/// timestamp less the advance of its arrival. With exact timestamps e is a difference of delays:
/// the same on average after an increment of 2 T and after one of T. After a slip e is (1 - f) T,
/// and -f T otherwise. So the excess
///     (mean e after 2 T - mean e after T) / T
/// is 0 for exact timestamps, 1 for slips, and in between where samples are lost besides. For f =
/// 1/24 (240 Hz in ticks of 4 ms) and 20 % losses, one increment of 2 T in six is a slip, and the
/// excess is 0.14.
///
/// A wrong "exact" costs an error of T in silence, a wrong "coarse" only precision. So, after an
/// increment of 2 T, timestamps count as coarse until the excess is clearly below half of its value
/// for slips once in 1 / f = 32 samples. Where delays vary by as much as a third of a tick (1 kHz
/// with 1 ms of jitter), that would take too many samples. Then the excess has to be clearly above
/// kSlipExcess to count as coarse. A tick that only sometimes slips is lost in jitter of its own
/// length.
///
/// Nothing can be concluded before the first slip, nor if the tick is exactly the period. Such a
/// clock is as good as one that counts frames, except for a constant that looks like delay.
class TimestampTicks {
  public:
    /// An increment (> 0) of the device's time, and of the times of arrival.
    void note(std::int64_t increment_ns, std::int64_t arrival_increment_ns);

    /// 0 where the timestamps are exact as far as anybody can tell.
    [[nodiscard]] std::int64_t tick_ns() const;

  private:
    struct Excess {
        std::uint64_t increments = 0;
        double sum_ns = 0.0;

        void add(double excess_ns);
        [[nodiscard]] double mean_ns() const;
    };
    [[nodiscard]] bool arrivals_bear_it_out() const;

    std::int64_t divisor_ns_ = 0;  ///< greatest common one
    std::int64_t least_ns_ = 0;
    Excess single_;  ///< behind increments of the least length
    Excess double_;  ///< of twice that
    double sum_of_amounts_ns_ = 0.0;
};

}  // namespace gazeloop::time
