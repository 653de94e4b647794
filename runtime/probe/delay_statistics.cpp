#include "runtime/probe/delay_statistics.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <vector>

namespace gazeloop::probe {
namespace {

/// The least value that at least this share of them does not exceed; none if they are too few.
std::optional<double> percentile(std::span<const double> sorted, double share) {
    const auto count = static_cast<double>(sorted.size());
    constexpr double kRounding = 1e-9;  // 1 / (1 - 0.95) is a bit more than 20
    if (count + kRounding < 1.0 / (1.0 - share)) {
        return std::nullopt;
    }
    const auto rank = static_cast<std::size_t>(std::ceil(share * count - kRounding));
    return sorted[std::clamp<std::size_t>(rank, 1, sorted.size()) - 1];
}

}  // namespace

double student_t_975(std::uint64_t degrees) {
    if (degrees == 1) {
        return 12.706205;
    }
    if (degrees == 2) {
        return 4.302653;
    }
    constexpr double z = 1.959964;
    const auto n = static_cast<double>(degrees);
    const double z2 = z * z;
    const double g1 = z * (z2 + 1.0) / 4.0;
    const double g2 = z * ((5.0 * z2 + 16.0) * z2 + 3.0) / 96.0;
    const double g3 = z * (((3.0 * z2 + 19.0) * z2 + 17.0) * z2 - 15.0) / 384.0;
    const double g4 =
        z * ((((79.0 * z2 + 776.0) * z2 + 1482.0) * z2 - 1920.0) * z2 - 945.0) / 92160.0;
    return z + (g1 + (g2 + (g3 + g4 / n) / n) / n) / n;
}

DelayStatistics delay_statistics(std::span<const double> delays_ms, const CameraErrors& camera) {
    DelayStatistics result{.trials = delays_ms.size()};
    if (delays_ms.empty()) {
        return result;
    }
    std::vector<double> sorted(delays_ms.begin(), delays_ms.end());
    std::ranges::sort(sorted);
    const auto count = static_cast<double>(sorted.size());
    const double mean = std::accumulate(sorted.begin(), sorted.end(), 0.0) / count;
    result.mean_ms = mean;
    result.min_ms = sorted.front();
    result.max_ms = sorted.back();
    result.p50_ms = percentile(sorted, 0.5);
    result.p95_ms = percentile(sorted, 0.95);
    result.uncertain_rate_ms = std::abs(mean) * camera.rate_percent / 100.0;
    result.uncertain_fixed_ms = camera.fixed_ms;
    if (sorted.size() > 1) {
        const double squares = std::accumulate(
            sorted.begin(), sorted.end(), 0.0,
            [mean](double sum, double delay) { return sum + (delay - mean) * (delay - mean); });
        result.sd_ms = std::sqrt(squares / (count - 1.0));
        result.uncertain_scatter_ms =
            std::max(student_t_975(sorted.size() - 1) * *result.sd_ms, camera.frame_ms) /
            std::sqrt(count);
    }
    return result;
}

}  // namespace gazeloop::probe
