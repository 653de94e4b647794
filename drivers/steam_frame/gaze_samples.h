#pragma once

#include <cmath>
#include <cstdint>
#include <deque>
#include <optional>
#include <string>

#include "drivers/device/sample_clock.h"
#include "drivers/device/tracker_device.h"
#include "drivers/steam_frame/gaze_record.h"
#include "drivers/steam_frame/raw_clock.h"

namespace gazeloop::drivers::steam_frame {

/// Which of the two rays per eye that the service publishes are used.
enum class Rays : std::uint8_t {
    Filtered,      ///< fused of both eyes, and filtered by the service
    BeforeFusion,  ///< of each eye by itself
};

/// Makes samples of the service's records, in the order of its counter. Allocates only where it has
/// something to report.
///
/// An eye is valid where its direction is finite and about of unit length. `sampled` is the stated
/// time, carried from CLOCK_MONOTONIC_RAW into ours, and as measured as that. Should stated times
/// not be of that clock (ages below 0 or above half a second, several in a row), that is reported.
/// The times then come of the clock fit and the profile's delay, as those of other trackers.
class GazeSamples {
  public:
    GazeSamples(const TrackerDelay& delay, Rays rays)
        : rays_(rays), clock_({kWide, kNanosecond_ns}, delay) {}

    /// The sample of a record with that counter, found at `arrived_ns`, without its number. `pair`
    /// was read at about that time.
    [[nodiscard]] gaze::GazeSample take(const GazeRecord& record, std::uint32_t counter,
                                        std::int64_t arrived_ns, const ClockPair& pair);

    /// Records that are missing before the last sample, by the service's counter. What was not
    /// published during a pause is no loss.
    [[nodiscard]] std::uint64_t lost_before_last() const { return lost_before_last_; }

    /// The time between records, as their times and counter say: also where most of them are
    /// missed. 0: not known yet.
    [[nodiscard]] std::int64_t period_ns() const { return std::llround(period_ns_); }

    /// A line about what the last records changed; none where nothing is left to say.
    [[nodiscard]] std::optional<std::string> take_change();

    /// Records with a time, a direction or a variance that cannot be one are damaged.
    [[nodiscard]] const TrackerCounts& counts() const { return counts_; }
    [[nodiscard]] const time::ClockFit& fit() const { return clock_.fit(); }
    /// Whether stated times are of CLOCK_MONOTONIC_RAW, as far as can be seen.
    [[nodiscard]] bool times_as_stated() const { return times_as_stated_; }

    /// So many ages in a row that cannot be turn that verdict; so many that can turn it back.
    static constexpr int kOddAges = 8;
    static constexpr int kGoodAges = 90;
    static constexpr std::int64_t kGreatestAge_ns = 500'000'000;

  private:
    static constexpr std::uint32_t kWide = 64;  ///< bits
    static constexpr double kNanosecond_ns = 1.0;

    /// Whether all its numbers can be what they should.
    bool set_eyes(const GazeRecord& record, gaze::GazeSample& sample);
    bool set_times(double time_s, std::int64_t arrived_ns, const ClockPair& pair,
                   gaze::GazeSample& sample);
    void judge_age(bool possible, std::int64_t age_ns);
    void count_lost(std::uint32_t counter, std::int64_t arrived_ns);
    void follow_period(std::uint32_t counter, double time_s);

    Rays rays_;
    SampleClock clock_;
    TrackerCounts counts_;
    std::uint64_t lost_before_last_ = 0;
    std::uint32_t last_counter_ = 0;
    double last_time_s_ = 0.0;
    double period_ns_ = 0.0;
    std::int64_t last_arrived_ns_ = 0;
    bool times_as_stated_ = true;
    int against_verdict_ = 0;  ///< ages in a row
    bool told_damaged_ = false;
    std::deque<std::string> notices_;
};

}  // namespace gazeloop::drivers::steam_frame
