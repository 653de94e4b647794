#include "runtime/statistics/block_bootstrap.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

#include "runtime/statistics/draw_below.h"

namespace gazeloop::statistics {
namespace {

constexpr std::size_t kLeastBlocks = 8;
/// More blocks than this say hardly more: the interval's width is then known within 2 %
/// (1/sqrt(2 blocks)). Longer blocks are as right as shorter ones.
constexpr std::size_t kMostBlocks = 2000;
/// Longer runs are averaged down to as many values before their correlation is looked at.
constexpr std::size_t kMostForCorrelation = 50'000;
constexpr std::size_t kLeastBeyondPercentile = 10;

double mean_of(std::span<const double> values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

/// Means of `size` neighbours each; what is left at the end is left out.
std::vector<double> averaged(std::span<const double> values, std::size_t size) {
    std::vector<double> means;
    means.reserve(values.size() / size);
    for (std::size_t at = 0; at + size <= values.size(); at += size) {
        means.push_back(mean_of(values.subspan(at, size)));
    }
    return means;
}

double autocovariance(std::span<const double> centred, std::size_t lag) {
    double sum = 0.0;
    for (std::size_t at = lag; at < centred.size(); ++at) {
        sum += centred[at] * centred[at - lag];
    }
    return sum / static_cast<double>(centred.size());
}

/// The length for values that are few enough to look at each lag.
double length_by_correlation(std::span<const double> values) {
    const auto count = static_cast<double>(values.size());
    const double mean = mean_of(values);
    std::vector<double> centred(values.begin(), values.end());
    for (double& value : centred) {
        value -= mean;
    }
    const double variance = autocovariance(centred, 0);
    if (!(variance > 0.0)) {
        return 1.0;  // all equal: no block is too short
    }
    // The first lag from which on several correlations in a row are no larger than chance makes
    // them; twice that is looked at.
    const auto in_a_row =
        static_cast<std::size_t>(std::max(5.0, std::ceil(std::sqrt(std::log10(count)))));
    const auto most_lags = std::min(
        static_cast<std::size_t>(std::ceil(std::sqrt(count))) + in_a_row, values.size() - 1);
    const double chance = 2.0 * std::sqrt(std::log10(count) / count);
    std::vector<double> covariances{variance};
    std::size_t small_ones = 0;
    std::size_t lags = 0;
    for (std::size_t lag = 1; lag <= most_lags; ++lag) {
        covariances.push_back(autocovariance(centred, lag));
        const bool small = std::abs(covariances[lag]) < chance * variance;
        small_ones = small ? small_ones + 1 : 0;
        lags = small ? lags : lag;
        if (small_ones == in_a_row) {
            break;
        }
    }
    const std::size_t window = std::min(std::max<std::size_t>(2 * lags, 1), most_lags);
    double weighted = 0.0;
    double spectrum = variance;
    for (std::size_t lag = 1; lag <= window; ++lag) {
        const double covariance =
            lag < covariances.size() ? covariances[lag] : autocovariance(centred, lag);
        const double share = static_cast<double>(lag) / static_cast<double>(window);
        const double weight = share <= 0.5 ? 1.0 : 2.0 * (1.0 - share);
        weighted += 2.0 * weight * static_cast<double>(lag) * covariance;
        spectrum += 2.0 * weight * covariance;
    }
    const double denominator = 4.0 / 3.0 * spectrum * spectrum;
    if (!(denominator > 0.0)) {
        return 1.0;
    }
    return std::cbrt(2.0 * weighted * weighted / denominator * count);
}

/// Draws sums of as many values as there are, in blocks that wrap around the end.
class Resampler {
  public:
    Resampler(std::span<const double> values, std::size_t length, std::uint64_t seed)
        : count_(values.size()), length_(length), random_(seed), mean_(mean_of(values)) {
        // Of deviations, so that sums of a long run keep their digits.
        sums_.reserve(count_ + length_ + 1);
        sums_.push_back(0.0);
        for (std::size_t at = 0; at < count_ + length_; ++at) {
            sums_.push_back(sums_.back() + (values[at % count_] - mean_));
        }
        blocks_ = (count_ + length_ - 1) / length_;
    }

    /// The mean of one resample.
    [[nodiscard]] double draw() {
        double sum = 0.0;
        for (std::size_t block = 0; block < blocks_; ++block) {
            const std::size_t from = draw_below(random_, count_);
            sum += sums_[from + length_] - sums_[from];
        }
        return mean_ + sum / static_cast<double>(blocks_ * length_);
    }

  private:
    std::size_t count_;
    std::size_t length_;
    std::size_t blocks_ = 0;
    std::mt19937_64 random_;
    double mean_;
    std::vector<double> sums_;
};

/// What one run's figure comes out as, resample by resample.
struct Resampled {
    double figure = 0.0;
    std::vector<double> draws;
};

std::optional<Resampler> resampler(std::span<const double> values, std::uint64_t seed) {
    if (values.size() < kLeastBlocks) {
        return std::nullopt;
    }
    const std::size_t length = std::max(block_length(values), values.size() / kMostBlocks);
    if (values.size() / length < kLeastBlocks) {
        return std::nullopt;
    }
    return Resampler(values, length, seed);
}

std::optional<Resampled> resampled_mean(std::span<const double> values, std::uint64_t seed,
                                        std::size_t resamples) {
    std::optional<Resampler> draw = resampler(values, seed);
    if (!draw) {
        return std::nullopt;
    }
    Resampled result{.figure = mean_of(values), .draws = {}};
    for (std::size_t resample = 0; resample < resamples; ++resample) {
        result.draws.push_back(draw->draw());
    }
    return result;
}

std::optional<Resampled> resampled_percentile(std::span<const double> values, double percent,
                                              std::uint64_t seed, std::size_t resamples) {
    const auto count = static_cast<double>(values.size());
    const double share = percent / 100.0;
    if (!(count * std::min(share, 1.0 - share) >= static_cast<double>(kLeastBeyondPercentile))) {
        return std::nullopt;
    }
    std::vector<double> sorted(values.begin(), values.end());
    std::ranges::sort(sorted);
    const auto value_at = [&sorted, count](double at_share) {
        const double rank = std::clamp(std::ceil(at_share * count), 1.0, count);
        return sorted[static_cast<std::size_t>(rank) - 1];
    };
    Resampled result{.figure = value_at(share), .draws = {}};
    std::vector<double> up_to_it(values.size());
    std::ranges::transform(values, up_to_it.begin(),
                           [&result](double value) { return value <= result.figure ? 1.0 : 0.0; });
    std::optional<Resampler> draw = resampler(up_to_it, seed);
    if (!draw) {
        return std::nullopt;
    }
    const double of_run = mean_of(up_to_it);
    for (std::size_t resample = 0; resample < resamples; ++resample) {
        result.draws.push_back(value_at(share + of_run - draw->draw()));
    }
    return result;
}

Difference difference(const Resampled& before, const Resampled& after, double level) {
    std::vector<double> changes(before.draws.size());
    for (std::size_t resample = 0; resample < changes.size(); ++resample) {
        changes[resample] = after.draws[resample] - before.draws[resample];
    }
    std::ranges::sort(changes);
    const auto at = [&changes](double share) {
        const auto last = static_cast<double>(changes.size() - 1);
        return changes[static_cast<std::size_t>(std::lround(share * last))];
    };
    return {.before = before.figure,
            .after = after.figure,
            .low = at((1.0 - level) / 2.0),
            .high = at((1.0 + level) / 2.0)};
}

/// The two runs are resampled independently of each other.
template <typename Resample>
std::optional<Difference> compared(const Resample& resample, std::span<const double> before,
                                   std::span<const double> after, const BootstrapOptions& options) {
    const std::size_t resamples = std::max<std::size_t>(options.resamples, 100);
    constexpr std::uint64_t kOther = 0x9e37'79b9'7f4a'7c15;
    const std::optional<Resampled> first = resample(before, options.seed, resamples);
    if (!first) {
        return std::nullopt;
    }
    const std::optional<Resampled> second = resample(after, options.seed ^ kOther, resamples);
    if (!second) {
        return std::nullopt;
    }
    return difference(*first, *second, options.level);
}

}  // namespace

std::size_t block_length(std::span<const double> values) {
    if (values.size() < 3) {
        return 1;
    }
    const std::size_t size = std::max<std::size_t>(values.size() / kMostForCorrelation, 1);
    const double length =
        size == 1 ? length_by_correlation(values)
                  : static_cast<double>(size) * length_by_correlation(averaged(values, size));
    const double most = std::floor(static_cast<double>(values.size()) / 3.0);
    return static_cast<std::size_t>(std::clamp(std::round(length), 1.0, most));
}

std::optional<Difference> difference_of_means(std::span<const double> before,
                                              std::span<const double> after,
                                              const BootstrapOptions& options) {
    return compared(resampled_mean, before, after, options);
}

std::optional<Difference> difference_of_percentiles(std::span<const double> before,
                                                    std::span<const double> after, double percent,
                                                    const BootstrapOptions& options) {
    return compared(
        [percent](std::span<const double> values, std::uint64_t seed, std::size_t resamples) {
            return resampled_percentile(values, percent, seed, resamples);
        },
        before, after, options);
}

}  // namespace gazeloop::statistics
