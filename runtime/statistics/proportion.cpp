#include "runtime/statistics/proportion.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <numeric>

#include "runtime/statistics/distributions.h"

namespace gazeloop::statistics {

Proportion wilson_interval(std::uint64_t yes, std::uint64_t trials, double level) {
    if (trials == 0) {
        return {.share = std::numeric_limits<double>::quiet_NaN()};
    }
    const auto n = static_cast<double>(trials);
    const double share = static_cast<double>(yes) / n;
    const double z = normal_quantile(0.5 * (1.0 + level));
    const double scale = 1.0 / (1.0 + z * z / n);
    const double middle = scale * (share + 0.5 * z * z / n);
    const double half = scale * z * std::sqrt(share * (1.0 - share) / n + 0.25 * z * z / (n * n));
    return {.yes = yes,
            .trials = trials,
            .share = share,
            // The bounds touch 0 and 1 there, but for rounding.
            .low = yes == 0 ? 0.0 : std::clamp(middle - half, 0.0, share),
            .high = yes == trials ? 1.0 : std::clamp(middle + half, share, 1.0)};
}

double mcnemar_p(std::uint64_t first_alone, std::uint64_t second_alone) {
    const std::uint64_t changed = first_alone + second_alone;
    const std::uint64_t fewer = std::min(first_alone, second_alone);
    const auto n = static_cast<double>(changed);
    double sum = 0.0;
    for (std::uint64_t k = 0; k <= fewer; ++k) {
        const auto of = static_cast<double>(k);
        sum += std::exp(std::lgamma(n + 1.0) - std::lgamma(of + 1.0) - std::lgamma(n - of + 1.0) -
                        n * std::numbers::ln2);
    }
    return std::min(2.0 * sum, 1.0);
}

std::vector<double> holm(std::span<const double> p) {
    std::vector<std::size_t> order(p.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::ranges::stable_sort(order, {}, [p](std::size_t at) { return p[at]; });
    std::vector<double> raised(p.size());
    double least = 0.0;
    for (std::size_t rank = 0; rank < order.size(); ++rank) {
        const auto left = static_cast<double>(order.size() - rank);
        least = std::max(least, std::min(left * p[order[rank]], 1.0));
        raised[order[rank]] = least;
    }
    return raised;
}

}  // namespace gazeloop::statistics
