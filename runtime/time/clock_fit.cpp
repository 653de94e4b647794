#include "runtime/time/clock_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/time/span.h"

namespace gazeloop::time {
namespace {

constexpr std::int64_t kBucket_ns = 250'000'000;
/// Over a longer gap a crystal may have drifted further than its samples say.
constexpr std::int64_t kLongestGap_ns = 120'000'000'000;
/// What the buckets span, at most, without gaps; steps within it count together.
constexpr std::int64_t kWindow_ns = 16'000'000'000;
constexpr std::int64_t kHoldEra_ns = 8'000'000'000;
/// Jitter makes a timestamp seem to stand still for longer than its tick, but not for so many.
constexpr std::int64_t kHoldsToStandStill = 8;
constexpr std::size_t kBucketsOfLastSecond = 4;

constexpr std::uint64_t kFewestSamples = 4;
/// Before, nobody knows how much jitter is usual.
constexpr std::uint64_t kFewestToJudge = 16;
constexpr std::uint64_t kFewestHeights = kFewestToJudge - 1;  // the first sample has none
/// With so many, what is still wrong is not for lack of samples.
constexpr std::uint64_t kManySamples = 100;
constexpr std::size_t kEarlyRunToStep = 3;
/// So many samples after an early one may be late ones of a clock that was set.
constexpr std::size_t kCalmAfterEarly = 2;
/// Two samples may come early within this and still be of the same clock.
constexpr double kLeastEarly_ns = 200e3;
/// If all others are earlier than a first sample by so much, it tells nothing of them: it waited,
/// or had the time of another run of the device.
constexpr double kOfAnotherTime_ns = 1e9;
constexpr double kLateHeights = 2.5;
constexpr double kLeastLate_ns = 50e3;
constexpr double kHeightMemory = 1.0 / 64.0;
constexpr double kUnusual = 10.0;
constexpr double kLeastUnusual_ns = 1e6;
/// exp(-4.6) is 1 %; twice, because the line rests on two points.
constexpr double kConfidence = 9.2;
/// After this span the slope is known well enough to outlive a step, give or take.
constexpr std::int64_t kSlopeKnownAfter_ns = 5'000'000'000;
constexpr double kSlopeAfterStep = 50e-6;

constexpr double kGood_ns = 1e6;
constexpr double kCoarse_ns = 10e6;

std::int64_t difference(std::int64_t from, std::int64_t to) {
    return saturated(static_cast<__int128>(to) - from);
}

}  // namespace

double ClockFit::Line::at(std::int64_t device_ns) const {
    return lag_ns + slope * static_cast<double>(difference(origin_ns, device_ns));
}

std::int64_t ClockFit::offset_ns() const {
    return saturated(offset_ + static_cast<__int128>(std::round(line_.at(last_device_ns_))));
}

ClockReading ClockFit::add(std::int64_t device_ns, std::int64_t arrived_ns) {
    if (!started_ || difference(last_arrived_ns_, arrived_ns) > kLongestGap_ns) {
        restart(device_ns, arrived_ns);
    }
    std::int64_t increment_ns = received_ == 0 ? 0 : difference(last_device_ns_, device_ns);
    const std::int64_t arrival_increment_ns =
        received_ == 0 ? 0 : difference(last_arrived_ns_, arrived_ns);
    // One that came right after its predecessor has waited with it, and tells nothing more.
    const bool queued = increment_ns > 0 && arrival_increment_ns < increment_ns / 2;
    if (backlog_ && queued) {
        restart(device_ns, arrived_ns);
        increment_ns = 0;
    } else {
        backlog_ = received_ == 0;
    }
    const Point point{device_ns,
                      saturated(static_cast<__int128>(arrived_ns) - device_ns - offset_)};
    recent_[received_ % kRunToStep] = point;
    ++received_;
    last_device_ns_ = device_ns;
    last_arrived_ns_ = arrived_ns;

    if (difference(hold_era_ns_, arrived_ns) > kHoldEra_ns) {
        longest_hold_ns_ = {0, longest_hold_ns_[0]};
        hold_era_ns_ = arrived_ns;
    }
    if (received_ > 1 && increment_ns == 0) {
        held_ns_ = difference(held_since_ns_, arrived_ns);
        return last_ = judge(point, arrived_ns);
    }
    if (held_ns_ > 0) {
        note_hold(increment_ns);
        held_ns_ = 0;
    }
    const bool jumped =
        received_ > 1 && note_increment(increment_ns, difference(held_since_ns_, arrived_ns));
    held_since_ns_ = arrived_ns;
    const bool jumped_once = jumped && regular_run_ >= kRecentIncrements;
    regular_run_ = jumped ? 0 : regular_run_ + 1;

    if (bucket_count_ > 0) {
        const double height = static_cast<double>(point.lag_ns) - line_.at(device_ns);
        const double uncertainty =
            line_uncertainty_ns(device_ns) + tick_ns() + static_cast<double>(polling_ns_);
        const bool judged = samples_ >= kFewestToJudge;
        if (judged && jumped_once) {
            jump_ns_ = device_ns;
            least_since_jump_ns_ = height;
        }
        least_since_jump_ns_ = std::min(least_since_jump_ns_, height);
        if (judged && -height > std::max(kLeastEarly_ns, uncertainty)) {
            late_run_ = 0;
            calm_run_ = 0;
            if (++early_run_ < kEarlyRunToStep) {
                return last_ = in_question(arrived_ns);
            }
            step(kEarlyRunToStep, arrived_ns);
            last_ = judge(point, arrived_ns);
            last_.stepped = true;
            return last_;
        }
        if (!judged && -height > std::max(kOfAnotherTime_ns, uncertainty)) {
            restart(device_ns, arrived_ns);
            return last_ = add(device_ns, arrived_ns);
        }
        // Not early. But a clock that was set shows so too while a sample is late by as much.
        if (early_run_ > 0 && ++calm_run_ <= kCalmAfterEarly) {
            return last_ = in_question(arrived_ns);
        }
        early_run_ = 0;
        const bool late = (judged || increment_ns < 0 || jumped_in_run_) &&
                          height > kLateHeights * mean_height_ns_ + uncertainty + kLeastLate_ns;
        if (!late) {
            late_run_ = 0;
            jumped_in_run_ = false;
        } else if (jumped && !jumped_in_run_) {
            late_run_ = 1;
            jumped_in_run_ = true;
        } else if (!queued) {
            ++late_run_;
        }
        if (jumped_in_run_) {
            if (late_run_ < kRunToStep) {
                return last_ = in_question(arrived_ns);
            }
            step(kRunToStep, arrived_ns);
            last_ = judge(point, arrived_ns);
            last_.stepped = true;
            return last_;
        }
        if (device_ns <= buckets_[bucket_count_ - 1].lowest.device_ns || (judged && jumped_once)) {
            return last_ =
                       in_question(arrived_ns);  // overtaken, or perhaps set and late by as much
        }
        if (!queued) {
            // A host that slept says little about the usual jitter.
            const double usual =
                std::clamp(height, 0.0, std::max(kUnusual * mean_height_ns_, kLeastUnusual_ns));
            ++heights_;
            mean_height_ns_ += (usual - mean_height_ns_) *
                               std::max(kHeightMemory, 1.0 / static_cast<double>(heights_));
        }
    }
    take(point);
    fit();
    return last_ = judge(point, arrived_ns);
}

/// All but the count of steps, which is the caller's, and when they were.
void ClockFit::restart(std::int64_t device_ns, std::int64_t arrived_ns) {
    const std::uint64_t steps = steps_;
    const auto step_times_ns = step_times_ns_;
    *this = ClockFit(polling_ns_);
    steps_ = steps;
    step_times_ns_ = step_times_ns;
    started_ = true;
    offset_ = static_cast<__int128>(arrived_ns) - device_ns;
    held_since_ns_ = arrived_ns;
    hold_era_ns_ = arrived_ns;
}

void ClockFit::take(const Point& point) {
    ++samples_;
    Bucket* newest = bucket_count_ > 0 ? &buckets_[bucket_count_ - 1] : nullptr;
    if (newest != nullptr && difference(newest->begin_ns, point.device_ns) < kBucket_ns) {
        ++newest->samples;
        const double distance =
            static_cast<double>(difference(newest->lowest.device_ns, point.device_ns));
        if (static_cast<double>(point.lag_ns) - line_.slope * distance <
            static_cast<double>(newest->lowest.lag_ns)) {
            newest->lowest = point;
        }
        return;
    }
    if (bucket_count_ == kMostBuckets) {
        samples_ -= buckets_.front().samples;
        std::shift_left(buckets_.begin(), buckets_.end(), 1);
        --bucket_count_;
    }
    buckets_[bucket_count_++] = {point.device_ns, 1, point};
}

void ClockFit::fit() {
    // Positions from the first point: exact in double for 104 days.
    const std::int64_t origin_ns = buckets_.front().lowest.device_ns;
    struct Corner {
        double x;
        double y;
    };
    std::array<Corner, kMostBuckets> hull;  // the lower hull, by a monotone chain
    std::size_t corners = 0;
    double mean_x = 0.0;
    for (std::size_t i = 0; i < bucket_count_; ++i) {
        const Point& point = buckets_[i].lowest;
        const Corner added{static_cast<double>(difference(origin_ns, point.device_ns)),
                           static_cast<double>(point.lag_ns)};
        mean_x += added.x / static_cast<double>(bucket_count_);
        while (corners >= 2) {
            const Corner& a = hull[corners - 2];
            const Corner& b = hull[corners - 1];
            if ((b.x - a.x) * (added.y - a.y) > (b.y - a.y) * (added.x - a.x)) {
                break;
            }
            --corners;
        }
        hull[corners++] = added;
    }
    double slope = 0.0;
    for (std::size_t i = 1; i < corners; ++i) {
        if (hull[i].x >= mean_x || i + 1 == corners) {
            slope = (hull[i].y - hull[i - 1].y) / (hull[i].x - hull[i - 1].x);
            break;
        }
    }
    if (hull[corners - 1].x >= static_cast<double>(kSlopeKnownAfter_ns)) {
        bounds_ = {};
    }
    slope = std::clamp(slope, bounds_.least, bounds_.greatest);
    double lag = std::numeric_limits<double>::infinity();
    for (std::size_t i = 0; i < corners; ++i) {
        lag = std::min(lag, hull[i].y - slope * (hull[i].x - mean_x));
    }
    const auto middle = static_cast<__int128>(std::round(mean_x));
    line_ = {saturated(origin_ns + middle), lag, slope};
}

/// Takes an increment of the device's time; whether it is unlike those before.
bool ClockFit::note_increment(std::int64_t increment_ns, std::int64_t arrival_increment_ns) {
    constexpr double kRegular = 0.1;
    if (increment_ns < 0) {
        return true;
    }
    bool irregular = false;
    if (period_ns_ > 0) {
        const auto period = static_cast<double>(period_ns_);
        const double ratio = static_cast<double>(increment_ns) / period;
        const double missed = std::max(1.0, std::round(ratio)) - ratio;
        irregular = std::abs(missed) * period > std::max(kRegular * period, tick_ns());
    }
    increments_[increment_count_++ % kRecentIncrements] = increment_ns;
    ticks_.note(increment_ns, arrival_increment_ns);
    constexpr std::uint64_t kEnough = 5;
    if (increment_count_ >= kEnough) {
        const auto known = static_cast<std::ptrdiff_t>(
            std::min<std::uint64_t>(increment_count_, kRecentIncrements));
        std::array<std::int64_t, kRecentIncrements> sorted = increments_;
        std::nth_element(sorted.begin(), sorted.begin() + known / 2, sorted.begin() + known);
        const bool first_known = period_ns_ == 0;
        period_ns_ = sorted[static_cast<std::size_t>(known / 2)];
        if (first_known && longest_hold_ns_[0] > longest_tick_ns()) {
            longest_hold_ns_ = {};
        }
    }
    return irregular;
}

/// A timestamp that moves on by more than that is no tick further, where ticks are what it moves
/// by.
std::int64_t ClockFit::longest_tick_ns() const {
    return saturated(static_cast<__int128>(period_ns_) + period_ns_ / 2);
}

/// The timestamp has changed at last: by a tick, or, where that is no length for the time it stood
/// still, by nothing to go by. A sample or a few that bore an old timestamp by mistake are neither:
/// the next one has moved on by their time too.
void ClockFit::note_hold(std::int64_t increment_ns) {
    if (period_ns_ > 0 && increment_ns > longest_tick_ns() &&
        held_ns_ / kHoldsToStandStill < period_ns_) {
        return;
    }
    const bool tick = increment_ns > held_ns_ / kHoldsToStandStill;
    longest_hold_ns_[0] = std::max(longest_hold_ns_[0], tick ? increment_ns : held_ns_);
}

/// The device's clock was set before the last `samples` samples: they begin a new line. Crystal and
/// transport stay what they were (mean_height_ns_, and bounds_ around the slope).
void ClockFit::step(std::size_t samples, std::int64_t arrived_ns) {
    const std::int64_t span_ns =
        difference(buckets_.front().begin_ns, buckets_[bucket_count_ - 1].begin_ns);
    if (span_ns >= kSlopeKnownAfter_ns) {
        bounds_ = {line_.slope - kSlopeAfterStep, line_.slope + kSlopeAfterStep};
    }
    ticks_ = {};  // the step itself was no multiple of them
    bucket_count_ = 0;
    samples_ = 0;
    early_run_ = 0;
    late_run_ = 0;
    jumped_in_run_ = false;
    least_since_jump_ns_ = 0.0;
    // Lags count from the new line, so that double holds them however far the clock was set.
    const std::int64_t base_ns = recent(samples - 1).lag_ns;
    offset_ += base_ns;
    for (Point& point : recent_) {
        point.lag_ns = saturated(static_cast<__int128>(point.lag_ns) - base_ns);
    }
    for (std::size_t back = samples; back-- > 0;) {
        const Point& point = recent(back);
        if (bucket_count_ == 0 || point.device_ns > buckets_[bucket_count_ - 1].lowest.device_ns) {
            take(point);
        }
    }
    fit();
    step_times_ns_[steps_++ % kRestlessSteps] = arrived_ns;
}

const ClockFit::Point& ClockFit::recent(std::size_t back) const {
    return recent_[(received_ - 1 - back) % kRunToStep];
}

double ClockFit::line_uncertainty_ns(std::int64_t device_ns) const {
    // Their median, not their mean: quarters of a second that the host slept through lie high up.
    std::array<double, kMostBuckets> heights{};
    for (std::size_t i = 0; i < bucket_count_; ++i) {
        const Point& point = buckets_[i].lowest;
        heights[i] = static_cast<double>(point.lag_ns) - line_.at(point.device_ns);
    }
    const auto middle = heights.begin() + static_cast<std::ptrdiff_t>(bucket_count_ / 2);
    std::nth_element(heights.begin(), middle,
                     heights.begin() + static_cast<std::ptrdiff_t>(bucket_count_));
    const double mean_height = *middle / std::numbers::ln2;  // of an exponential distribution
    const double envelope =
        kConfidence * std::max(2.0 * mean_height_ns_ / static_cast<double>(samples_),
                               mean_height / static_cast<double>(bucket_count_));
    const auto half_span =
        0.5 * static_cast<double>(difference(buckets_.front().lowest.device_ns,
                                             buckets_[bucket_count_ - 1].lowest.device_ns));
    const double away = std::abs(static_cast<double>(difference(line_.origin_ns, device_ns)));
    const double greatest_slope = 0.5 * (bounds_.greatest - bounds_.least);
    const double slope =
        half_span > 0.0 ? std::min(greatest_slope, envelope / half_span) : greatest_slope;
    return envelope + slope * away;
}

std::int64_t ClockFit::hold_ns() const {
    const std::int64_t before = std::max(longest_hold_ns_[0], longest_hold_ns_[1]);
    // Where timestamps do not usually stand still, how old this one is is known to a period.
    return held_ns_ / kHoldsToStandStill > before
               ? saturated(static_cast<__int128>(held_ns_) + period_ns_)
               : before;
}

double ClockFit::tick_ns() const {
    return static_cast<double>(std::max(hold_ns(), ticks_.tick_ns()));
}

/// How high above the line even the lowest sample of the last second lies.
double ClockFit::height_of_last_second_ns() const {
    if (bucket_count_ < kBucketsOfLastSecond) {
        return 0.0;
    }
    double least = std::numeric_limits<double>::infinity();
    for (std::size_t i = bucket_count_ - kBucketsOfLastSecond; i < bucket_count_; ++i) {
        const Point& point = buckets_[i].lowest;
        least = std::min(least, static_cast<double>(point.lag_ns) - line_.at(point.device_ns));
    }
    return std::max(least, 0.0);
}

/// The same for the samples since regular timestamps jumped: the clock may have been set back by so
/// much. 0 once all samples of the last second came after the jump.
double ClockFit::height_since_jump_ns() const {
    const bool covered = bucket_count_ >= kBucketsOfLastSecond &&
                         buckets_[bucket_count_ - kBucketsOfLastSecond].begin_ns >= jump_ns_;
    return covered ? 0.0 : std::max(least_since_jump_ns_, 0.0);
}

bool ClockFit::restless(std::int64_t arrived_ns) const {
    return steps_ >= kRestlessSteps &&
           difference(step_times_ns_[steps_ % kRestlessSteps], arrived_ns) < kWindow_ns;
}

ClockReading ClockFit::in_question(std::int64_t arrived_ns) {
    return unknown(restless(arrived_ns) ? ClockTrouble::Restless : ClockTrouble::Settling);
}

ClockReading ClockFit::unknown(ClockTrouble trouble) {
    trouble_ = trouble;
    return {};
}

ClockReading ClockFit::judge(const Point& point, std::int64_t arrived_ns) {
    if (restless(arrived_ns)) {
        return unknown(ClockTrouble::Restless);
    }
    if (static_cast<double>(hold_ns()) > kCoarse_ns) {
        return unknown(ClockTrouble::StandsStill);
    }
    if (samples_ < kFewestSamples || heights_ < kFewestHeights) {
        return unknown(ClockTrouble::Settling);
    }
    const double line = line_uncertainty_ns(point.device_ns);
    const double tick = tick_ns();
    const double late = std::max(height_of_last_second_ns(), height_since_jump_ns());
    const auto polled = static_cast<double>(polling_ns_);
    const double uncertainty = line + tick + late + polled;
    const double most = std::max({line, tick, late, polled});
    trouble_ = uncertainty <= kGood_ns   ? ClockTrouble::None
               : tick >= most            ? ClockTrouble::CoarseTicks
               : polled >= most          ? ClockTrouble::Polled
               : late >= most            ? ClockTrouble::Late
               : samples_ < kManySamples ? ClockTrouble::Settling
                                         : ClockTrouble::Jitter;
    if (uncertainty > kCoarse_ns) {
        return unknown(trouble_);
    }
    const __int128 host = static_cast<__int128>(point.device_ns) + offset_ +
                          static_cast<__int128>(std::round(line_.at(point.device_ns))) -
                          polling_ns_ / 2;
    return {.host_ns = std::min(saturated(host), arrived_ns),
            .uncertainty_ns = std::llround(uncertainty),
            .verdict = uncertainty <= kGood_ns ? ClockVerdict::Good : ClockVerdict::Coarse};
}

}  // namespace gazeloop::time
