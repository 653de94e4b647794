#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

#include "runtime/time/timestamp_ticks.h"

namespace gazeloop::time {

/// What a device's timestamps are worth.
enum class ClockVerdict : std::uint8_t {
    Good,      ///< known to within 1 ms
    Coarse,    ///< known to within 10 ms
    Unusable,  ///< the time of a sample is unknown
};
inline constexpr std::array<std::string_view, 3> kClockVerdictNames{"good", "coarse", "unusable"};

/// What keeps a verdict from being good.
enum class ClockTrouble : std::uint8_t {
    None,
    Settling,     ///< too few samples yet, or just after a step
    StandsStill,  ///< several samples bear the same timestamp
    CoarseTicks,  ///< timestamps are multiples of something long
    Polled,       ///< the host asks for samples seldom
    Restless,     ///< it steps again and again: set back, or at another rate than it claims
    Late,         ///< samples arrive ever later, or the clock is too slow: which, nobody knows
    Jitter,       ///< too much of it for the number of samples
};
inline constexpr std::array<std::string_view, 8> kClockTroubleNames{
    "none",     "settling", "timestamps stand still", "coarse ticks", "polled",
    "restless", "late",     "delivery jitter"};

/// One sample's time.
struct ClockReading {
    std::int64_t host_ns = 0;         ///< meaningless if unusable; never after the arrival
    std::int64_t uncertainty_ns = 0;  ///< meaningless if unusable
    ClockVerdict verdict = ClockVerdict::Unusable;
    bool stepped = false;  ///< with this sample it is clear that the device's clock was set
};

/// From a device's clock to CLOCK_MONOTONIC, sample by sample, without allocation.
///
/// A sample cannot arrive before it was taken: arrival = device time + offset + skew x device time
/// + least delay + jitter, with jitter >= 0. So the clock is the line below all points (device
/// time, arrival - device time). Of all lines below the points, the one that is highest at their
/// mean device time is taken. It is an edge of their lower convex hull, and the likeliest line for
/// exponential jitter. (Moon, Skelly and Towsley 1999, "Estimation and removal of clock skew from
/// network delay measurements".) The points are the lowest one of each quarter of a second, for up
/// to 64 quarters.
///
/// **What comes out is the true time plus the least delay.** That constant cannot be seen from here
/// and has to come from the tracker's profile.
///
/// Uncertainty. With n samples whose jitter has density f at 0, the least of them is 1 / (n f) too
/// high on average. It is too high by more than x with a probability of exp(-x n f). 1 / (n f) is
/// estimated in two ways. From the mean delay m of samples above the line: 2 m / n (exact for
/// uniform, twice too much for exponential jitter). From the heights of the k lowest points above
/// it: their mean (by their median) over k. The larger one times kConfidence is the uncertainty of
/// the line where its points are. Beyond the points the uncertainty of its slope is added, which is
/// never more than crystals are off. Added to that are the length of a tick (timestamp_ticks.h),
/// and by how much everything in the last second was late. On simulated clocks whose delays vary at
/// random from sample to sample, at most 1 % of the readings lie outside (tests). That holds for
/// the first readings too, because times are unknown until 16 samples have shown what jitter is
/// usual.
///
/// Delays that do not vary at random are another matter. A host that asks for samples at fixed
/// times delays each by what is left until it asks again. That delay is a sawtooth that repeats
/// only with the beat of both periods, perhaps after minutes, and cannot be told from skew. The
/// line then runs anywhere between 0 and the polling interval above the truth. Where it follows a
/// fall of the sawtooth that is over, it runs by up to 0.4 of the interval below (simulated). So
/// half the interval is subtracted from the time. All of it is added to the uncertainty, and to the
/// limits of early and late. The interval has to be known from elsewhere: with 1 ms of it no clock
/// is good.
///
/// If reports were already queued when reading began, only the last of that queue is used. Leading
/// samples whose timestamps belong to an earlier run of the device are dropped as well. A timestamp
/// that is repeated now and then does not make a coarse tick: the time of that sample is unknown,
/// and nothing follows from it.
///
/// Late delivery can make any sample late, but not early. A step of the device's clock therefore
/// shows in one of two ways. Samples come early: three, with no more than two others between them.
/// Or device times become irregular: then eight late samples in a row are a step. A step is found
/// within 10 samples if it is longer than 2.5 times the mean delay above the line plus the
/// uncertainty. Shorter ones are absorbed within 16 s. The uncertainty covers them until then: at
/// once where timestamps that were regular to a tenth of their period jump, else after a second.
///
/// While a step is suspected, sample times are unknown: of early and late samples, of the two after
/// an early one, and of the first after regular timestamps jump. One case cannot be detected: a
/// step of exactly n periods whose first sample is n periods late looks like n lost samples. (For 6
/// ms and more, with 1 ms of exponential jitter: 1 of 30,000 streams.)
///
/// What is forgotten. Setting a clock, or resetting the device, moves only its offset. The crystal
/// is the same, so that the slope may change by no more than crystals drift. The way to the host
/// and its usual jitter are the same too. After two minutes without a sample nobody knows what went
/// on. The device may be in another mode with another clock, warm or cold, behind another hub or
/// driver. Everything is learnt anew then, which costs seconds of a wider uncertainty; keeping what
/// no longer holds would state one that is too narrow. A device that is plugged in again gets a
/// ClockFit of its own.
class ClockFit {
  public:
    /// Greatest skew that is believed, as a ratio: crystals are good to 100 ppm.
    static constexpr double kGreatestSkew = 500e-6;

    /// The host asks for samples every `polling_ns` (0: they come by themselves).
    explicit ClockFit(std::int64_t polling_ns = 0) : polling_ns_(polling_ns) {}

    /// A sample of the device's clock, and when it had arrived, in the order of arrival.
    ClockReading add(std::int64_t device_ns, std::int64_t arrived_ns);

    /// As of the last sample.
    [[nodiscard]] const ClockReading& last() const { return last_; }
    [[nodiscard]] ClockTrouble trouble() const { return trouble_; }
    /// By how much the device's second is too short, parts per million (positive: its clock is
    /// slow). Meaningless while settling.
    [[nodiscard]] double skew_ppm() const { return line_.slope * 1e6; }
    /// How much later than the line samples arrive on average. Meaningless while settling.
    [[nodiscard]] double jitter_ns() const { return mean_height_ns_; }
    /// What is to be added to the last sample's device time, so that it is host time (with the
    /// least delay in it). Meaningless if that is unusable.
    [[nodiscard]] std::int64_t offset_ns() const;
    [[nodiscard]] std::uint64_t steps() const { return steps_; }
    /// The usual time between timestamps that differ, of the device's clock; 0: not known yet.
    [[nodiscard]] std::int64_t period_ns() const { return period_ns_; }

  private:
    static constexpr std::size_t kMostBuckets = 64;
    static constexpr std::size_t kRunToStep = 8;
    static constexpr std::size_t kRecentIncrements = 15;
    static constexpr std::size_t kRestlessSteps = 3;

    struct Point {
        std::int64_t device_ns = 0;
        std::int64_t lag_ns = 0;  ///< arrival - device time - offset_
    };
    struct Bucket {
        std::int64_t begin_ns = 0;
        std::uint64_t samples = 0;
        Point lowest;
    };
    /// Lag over device time, from an origin that lies among the points.
    struct Line {
        std::int64_t origin_ns = 0;
        double lag_ns = 0.0;
        double slope = 0.0;

        [[nodiscard]] double at(std::int64_t device_ns) const;
    };
    struct SlopeBounds {
        double least = -kGreatestSkew;
        double greatest = kGreatestSkew;
    };

    void restart(std::int64_t device_ns, std::int64_t arrived_ns);
    void take(const Point& point);
    void fit();
    [[nodiscard]] bool note_increment(std::int64_t increment_ns, std::int64_t arrival_increment_ns);
    [[nodiscard]] std::int64_t longest_tick_ns() const;
    void note_hold(std::int64_t increment_ns);
    void step(std::size_t samples, std::int64_t arrived_ns);
    [[nodiscard]] double line_uncertainty_ns(std::int64_t device_ns) const;
    [[nodiscard]] std::int64_t hold_ns() const;
    [[nodiscard]] double tick_ns() const;
    [[nodiscard]] double height_of_last_second_ns() const;
    [[nodiscard]] double height_since_jump_ns() const;
    [[nodiscard]] bool restless(std::int64_t arrived_ns) const;
    [[nodiscard]] ClockReading judge(const Point& point, std::int64_t arrived_ns);
    [[nodiscard]] ClockReading in_question(std::int64_t arrived_ns);
    [[nodiscard]] ClockReading unknown(ClockTrouble trouble);
    [[nodiscard]] const Point& recent(std::size_t back) const;

    std::int64_t polling_ns_;
    bool started_ = false;
    __int128 offset_ = 0;  ///< arrival - device time of the first sample
    std::int64_t last_device_ns_ = 0;
    std::int64_t last_arrived_ns_ = 0;

    std::array<Bucket, kMostBuckets> buckets_;  ///< in order of device time
    std::size_t bucket_count_ = 0;
    std::uint64_t samples_ = 0;  ///< in the buckets
    Line line_;
    SlopeBounds bounds_;
    double mean_height_ns_ = 0.0;  ///< of samples above the line, over about 64 of them
    std::uint64_t heights_ = 0;    ///< that it rests on

    std::array<Point, kRunToStep> recent_;  ///< ring
    std::uint64_t received_ = 0;
    bool backlog_ = true;        ///< every sample has waited with the first
    std::size_t early_run_ = 0;  ///< with no more than kCalmAfterEarly others between them
    std::size_t calm_run_ = 0;   ///< since the last of them
    std::size_t late_run_ = 0;
    bool jumped_in_run_ = false;
    std::int64_t jump_ns_ = 0;          ///< device time of the last jump of regular timestamps
    double least_since_jump_ns_ = 0.0;  ///< above the line

    std::array<std::int64_t, kRecentIncrements> increments_{};  ///< ring
    std::uint64_t increment_count_ = 0;
    std::size_t regular_run_ = 0;  ///< increments like those before, in a row
    std::int64_t period_ns_ = 0;   ///< their median
    TimestampTicks ticks_;
    std::int64_t held_since_ns_ = 0;                 ///< arrival of the first with this timestamp
    std::int64_t held_ns_ = 0;                       ///< 0: the last timestamp was a new one
    std::array<std::int64_t, 2> longest_hold_ns_{};  ///< of these and the 8 s before
    std::int64_t hold_era_ns_ = 0;

    std::array<std::int64_t, kRestlessSteps> step_times_ns_{};  ///< ring
    std::uint64_t steps_ = 0;
    ClockTrouble trouble_ = ClockTrouble::Settling;
    ClockReading last_;
};

}  // namespace gazeloop::time
