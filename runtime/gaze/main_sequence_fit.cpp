#include "runtime/gaze/main_sequence_fit.h"

#include <algorithm>
#include <cmath>
#include <iterator>

#include "runtime/gaze/main_sequence.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::gaze {
namespace {

bool is_usable(const SaccadePoint& point) {
    return std::isfinite(point.amplitude_deg) && std::isfinite(point.peak_deg_per_s) &&
           std::isfinite(point.duration_ms) && point.amplitude_deg > 0.0 &&
           point.peak_deg_per_s > 0.0 && point.duration_ms > 0.0;
}

/// With a bend, the best saturation is that of a line through 0.
struct PeakFit {
    double saturation = 0.0;
    double squares = 0.0;
};

PeakFit peak_fit(std::span<const SaccadePoint> points, double bend_deg) {
    double xy = 0.0;
    double xx = 0.0;
    double yy = 0.0;
    for (const SaccadePoint& point : points) {
        const double x = -std::expm1(-point.amplitude_deg / bend_deg);
        xy += x * point.peak_deg_per_s;
        xx += x * x;
        yy += point.peak_deg_per_s * point.peak_deg_per_s;
    }
    return {xy / xx, std::max(yy - xy * xy / xx, 0.0)};  // xx: some amplitude is above 0
}

/// The best of 64 steps of a factor of 1.075 each, then a golden section between its neighbours, to
/// 1e-4 of itself.
double best_bend_deg(std::span<const SaccadePoint> points) {
    constexpr int kSteps = 64;
    constexpr double kGolden = 0.6180339887498949;
    constexpr double kClose = 1e-4;
    const auto squares = [&](double log_bend) {
        return peak_fit(points, std::exp(log_bend)).squares;
    };
    const double least = std::log(kLeastBend_deg);
    const double step = (std::log(kMostBend_deg) - least) / kSteps;
    int best = 0;
    for (int i = 1; i <= kSteps; ++i) {
        best = squares(least + i * step) < squares(least + best * step) ? i : best;
    }
    double low = least + std::max(best - 1, 0) * step;
    double high = least + std::min(best + 1, kSteps) * step;
    while (high - low > kClose) {
        const double left = high - kGolden * (high - low);
        const double right = low + kGolden * (high - low);
        if (squares(left) < squares(right)) {
            high = right;
        } else {
            low = left;
        }
    }
    return std::exp(0.5 * (low + high));
}

}  // namespace

std::optional<MainSequenceFit> fit_main_sequence(std::span<const SaccadePoint> saccades) {
    memory::LongVector<SaccadePoint> points;
    std::ranges::copy_if(saccades, std::back_inserter(points), is_usable);
    if (points.size() < kFewestForMainSequence) {
        return std::nullopt;
    }
    const auto count = static_cast<double>(points.size());
    double mean_a = 0.0;
    double mean_d = 0.0;
    for (const SaccadePoint& point : points) {
        mean_a += point.amplitude_deg / count;
        mean_d += point.duration_ms / count;
    }
    double aa = 0.0;
    double ad = 0.0;
    double dd = 0.0;
    for (const SaccadePoint& point : points) {
        const double a = point.amplitude_deg - mean_a;
        const double d = point.duration_ms - mean_d;
        aa += a * a;
        ad += a * d;
        dd += d * d;
    }
    if (!(aa > 0.0)) {
        return std::nullopt;
    }
    MainSequenceFit fit{.saccades = points.size()};
    fit.ms_per_deg = ad / aa;
    fit.intercept_ms = mean_d - fit.ms_per_deg * mean_a;
    fit.duration_rmse_ms = std::sqrt(std::max(dd - fit.ms_per_deg * ad, 0.0) / count);
    fit.bend_deg = best_bend_deg(points);
    const PeakFit peak = peak_fit(points, fit.bend_deg);
    fit.saturation_deg_per_s = peak.saturation;
    fit.peak_rmse_deg_per_s = std::sqrt(peak.squares / count);
    constexpr double kBesideTheEnd = 0.9;
    fit.saturates = fit.bend_deg < kBesideTheEnd * kMostBend_deg;
    memory::LongVector<double> ratios;
    ratios.reserve(points.size());
    for (const SaccadePoint& point : points) {
        ratios.push_back(point.peak_deg_per_s / main_sequence(point.amplitude_deg).peak_deg_per_s);
    }
    const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
    std::ranges::nth_element(ratios, middle);
    fit.peak_over_published = *middle;
    return fit;
}

}  // namespace gazeloop::gaze
