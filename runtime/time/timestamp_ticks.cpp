#include "runtime/time/timestamp_ticks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/time/span.h"

namespace gazeloop::time {
namespace {

/// One wrong timestamp, or a clock that was set, must not decide what the ticks are for ever.
constexpr std::int64_t kLongestIncrements = 8;
/// Slips that are rarer than one in so many samples are found by their excess of nearly 1 alone.
constexpr double kSamplesPerSlip = 32.0;
/// Half of the excess of slips among 20 % of losses, and a bit less than half of it without.
constexpr double kLeastDoubtful = 0.07;
constexpr double kMostDoubtful = 0.4;
/// Queues make up to 0.2 of it where delays vary by as much as samples are apart.
constexpr double kSlipExcess = 0.3;
/// From the mean amount to the standard deviation of what is distributed exponentially, either
/// way, as the difference of two exponential delays is. Of uniform delays it is less.
constexpr double kDeviations = 1.42;
constexpr double kSigmas = 2.0;
/// Delays that vary by more than a tick over this hide slips among losses.
constexpr double kTickOverDelays = 3.0;

}  // namespace

void TimestampTicks::Excess::add(double excess_ns) {
    ++increments;
    sum_ns += excess_ns;
}

double TimestampTicks::Excess::mean_ns() const {
    return increments == 0 ? 0.0 : sum_ns / static_cast<double>(increments);
}

void TimestampTicks::note(std::int64_t increment_ns, std::int64_t arrival_increment_ns) {
    if (least_ns_ == 0 || increment_ns < least_ns_) {
        least_ns_ = increment_ns;
        single_ = {};
        double_ = {};
        sum_of_amounts_ns_ = 0.0;
    }
    if (increment_ns / kLongestIncrements >= least_ns_) {
        return;
    }
    divisor_ns_ = std::gcd(divisor_ns_, increment_ns);
    const bool doubled = increment_ns / 2 == least_ns_ && increment_ns % 2 == 0;
    if (!doubled && increment_ns != least_ns_) {
        return;
    }
    // A host that slept says little about the delays.
    const double most_ns = 2.0 * static_cast<double>(least_ns_);
    const double excess_ns = std::clamp(
        static_cast<double>(saturated(static_cast<__int128>(increment_ns) - arrival_increment_ns)),
        -most_ns, most_ns);
    (doubled ? double_ : single_).add(excess_ns);
    sum_of_amounts_ns_ += std::abs(excess_ns);
}

std::int64_t TimestampTicks::tick_ns() const {
    const bool certain = divisor_ns_ < least_ns_;
    return certain || (double_.increments > 0 && !arrivals_bear_it_out()) ? divisor_ns_ : 0;
}

bool TimestampTicks::arrivals_bear_it_out() const {
    const auto tick_ns = static_cast<double>(least_ns_);
    const auto singles = static_cast<double>(std::max<std::uint64_t>(single_.increments, 1));
    const auto doubles = static_cast<double>(double_.increments);
    const double delays_ns =
        sum_of_amounts_ns_ / static_cast<double>(single_.increments + double_.increments);
    const double excess = (double_.mean_ns() - single_.mean_ns()) / tick_ns;
    const double error =
        kSigmas * kDeviations * delays_ns / tick_ns * std::sqrt(1.0 / singles + 1.0 / doubles);
    if (tick_ns <= kTickOverDelays * delays_ns) {
        return excess - error < kSlipExcess;
    }
    const double doubtful = std::clamp(0.5 / kSamplesPerSlip * (singles + doubles) / doubles,
                                       kLeastDoubtful, kMostDoubtful);
    return excess + error < doubtful;
}

}  // namespace gazeloop::time
