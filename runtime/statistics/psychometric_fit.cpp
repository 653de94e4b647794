#include "runtime/statistics/psychometric_fit.h"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "runtime/statistics/distributions.h"
#include "runtime/statistics/draw_below.h"
#include "runtime/statistics/people_posterior.h"
#include "runtime/statistics/posterior_draws.h"

namespace gazeloop::statistics {
namespace {

constexpr std::uint32_t kLeastResamples = 50;

/// Deviation of the threshold over resamples, each of which `draw` makes of how often each subject
/// counts, or of the counts.
template <typename Resample>
double deviation_over(const Resample& resample, const FitOptions& options) {
    const std::uint32_t resamples = std::max(options.resamples, kLeastResamples);
    double mean = 0.0;
    double squares = 0.0;
    for (std::uint32_t i = 0; i < resamples; ++i) {
        const double x = resample();
        const double off = x - mean;
        mean += off / (i + 1.0);
        squares += off * (x - mean);
    }
    return std::sqrt(squares / (resamples - 1.0));
}

/// How far the threshold is off because nobody knows how the function bends: resamples are all
/// drawn to the prior's middle, and so do not show it. Over functions as the prior has them.
double bend_deviation(const PeoplePosterior& posterior, const PeoplePosterior::Parameters& best,
                      const FitOptions& options) {
    const auto x_about = [&](double bend) {
        const PeoplePosterior other = posterior.with_bend_about(bend);
        const std::vector<double> once(posterior.subjects(), 1.0);
        return other.function_of(other.most_probable(best, once))
            .together()
            .x_where(options.criterion);
    };
    constexpr double kDeviation = PeoplePosterior::kPriorBend;
    return 0.5 * std::abs(x_about(kDeviation) - x_about(-kDeviation));
}

/// The median and interval of the threshold by its posterior.
void take_posterior(FittedThreshold& result, const PeoplePosterior& posterior,
                    const PeoplePosterior::Parameters& best, const FitOptions& options) {
    constexpr std::size_t kDrawsPerResample = 10;  // as long as fitting a resample takes
    struct Weighted {
        double x;
        double weight;
    };
    std::vector<Weighted> all;
    double mean = 0.0;
    for (const PosteriorDraw& draw :
         draw_posterior(posterior, best, options.seed,
                        kDrawsPerResample * std::max(options.resamples, kLeastResamples))) {
        if (draw.weight > 0.0) {
            const double x =
                posterior.function_of(draw.parameters).together().x_where(options.criterion);
            all.push_back({x, draw.weight});
            mean += draw.weight * x;
        }
    }
    std::ranges::sort(all, {}, &Weighted::x);
    double squares = 0.0;
    double below = 0.0;
    const double tail = 0.5 * (1.0 - options.level);
    result.low = result.x = result.high = all.front().x;
    for (const Weighted& one : all) {
        squares += one.weight * (one.x - mean) * (one.x - mean);
        result.low = below <= tail ? one.x : result.low;
        result.x = below <= 0.5 ? one.x : result.x;
        result.high = below <= 1.0 - tail ? one.x : result.high;
        below += one.weight;
    }
    result.deviation = std::sqrt(squares);
}

std::vector<double> once_each(std::size_t count) { return std::vector<double>(count, 1.0); }

}  // namespace

double PsychometricFunction::at(double x) const {
    const double u = (rising ? 1.0 : -1.0) * (x - threshold) / spread;
    return lowest + (1.0 - lowest - highest) * normal_share(bent(u, bend).value);
}

PsychometricFunction::Bent PsychometricFunction::bent(double u, double bend) {
    constexpr double kStraight = 1e-4;
    constexpr double kMostExponent = 30.0;  // the normal's tails have ended long before
    if (std::abs(bend) < kStraight) {
        return {u + 0.5 * bend * u * u, 1.0 + bend * u, 0.5 * u * u + bend * u * u * u / 3.0};
    }
    const double exponent = std::clamp(bend * u, -kMostExponent, kMostExponent);
    const double power = std::exp(exponent);
    const double value = std::expm1(exponent) / bend;
    return {value, power, (exponent * power / bend - value) / bend};
}

double PsychometricFunction::x_where(double yes) const {
    constexpr double kEnd = 1e-3;
    const double decided = std::clamp((yes - lowest) / (1.0 - lowest - highest), kEnd, 1.0 - kEnd);
    const double z = normal_quantile(decided);
    // Where g ends before z: beyond where it changes by more than a thousandth.
    const double u = bend == 0.0 ? z : std::log(std::max(1.0 + bend * z, kEnd)) / bend;
    return threshold + (rising ? 1.0 : -1.0) * spread * u;
}

PsychometricFunction FittedPeople::together() const {
    PsychometricFunction all = function;
    all.spread = std::hypot(function.spread, people);
    // g bends with x as before; its mean over people is that of an exponential.
    const double share = people / function.spread;
    all.bend = function.bend * all.spread / function.spread;
    all.threshold -=
        (function.rising ? 0.5 : -0.5) * function.bend * share * share * function.spread;
    return all;
}

FittedPeople fit_people(std::span<const std::vector<LevelCount>> subjects,
                        const FitOptions& options) {
    const PeoplePosterior posterior(subjects, options.rising, options.adaptive);
    return posterior.function_of(
        posterior.most_probable(posterior.start(), once_each(posterior.subjects())));
}

FittedThreshold fit_threshold(std::span<const std::vector<LevelCount>> subjects,
                              const FitOptions& options) {
    const PeoplePosterior posterior(subjects, options.rising, options.adaptive);
    const std::size_t n = posterior.subjects();
    const PeoplePosterior::Parameters best =
        posterior.most_probable(posterior.start(), once_each(n));
    FittedThreshold result{.people = posterior.function_of(best)};
    result.x = result.people.together().x_where(options.criterion);
    if (options.adaptive) {
        take_posterior(result, posterior, best, options);
        result.outside = result.x < posterior.least() || result.x > posterior.most();
        return result;
    }
    result.outside = result.x < posterior.least() || result.x > posterior.most();
    std::mt19937_64 random(options.seed);
    double factor = 0.0;
    if (n > 1) {
        result.deviation = deviation_over(
            [&] {
                std::vector<double> times(n, 0.0);
                for (std::size_t i = 0; i < n; ++i) {
                    times[draw_below(random, n)] += 1.0;
                }
                return posterior.function_of(posterior.most_probable(best, times))
                    .together()
                    .x_where(options.criterion);
            },
            options);
        factor = student_quantile(0.5 * (1.0 + options.level), static_cast<unsigned>(n - 1)) *
                 std::sqrt(static_cast<double>(n) / static_cast<double>(n - 1));
    } else {
        std::vector<std::vector<LevelCount>> drawn{posterior.counts(0)};
        result.deviation = deviation_over(
            [&] {
                for (LevelCount& count : drawn.front()) {
                    const double p = result.people.function.at(count.x);
                    count.yes = 0;
                    for (std::uint32_t trial = 0; trial < count.trials; ++trial) {
                        count.yes += static_cast<double>(random() >> 11U) * 0x1p-53 < p ? 1 : 0;
                    }
                }
                const PeoplePosterior of_drawn(drawn, options.rising, options.adaptive);
                return of_drawn.function_of(of_drawn.most_probable(best, once_each(1)))
                    .together()
                    .x_where(options.criterion);
            },
            options);
        factor = normal_quantile(0.5 * (1.0 + options.level));
    }
    result.deviation = std::hypot(result.deviation, bend_deviation(posterior, best, options));
    result.low = result.x - factor * result.deviation;
    result.high = result.x + factor * result.deviation;
    return result;
}

}  // namespace gazeloop::statistics
