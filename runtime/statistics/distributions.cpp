#include "runtime/statistics/distributions.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gazeloop::statistics {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

double normal_density(double z) {
    return std::exp(-0.5 * z * z) / std::sqrt(2.0 * std::numbers::pi);
}

/// P(|T| <= t), by its finite sums (Abramowitz and Stegun 26.7.3 and 26.7.4).
double student_within(double t, unsigned degrees_of_freedom) {
    const double theta = std::atan(t / std::sqrt(static_cast<double>(degrees_of_freedom)));
    const double cosine = std::cos(theta);
    const bool odd = degrees_of_freedom % 2 == 1;
    double term = odd ? cosine : 1.0;
    double sum = 0.0;
    for (unsigned i = odd ? 1 : 0; i + 1 < degrees_of_freedom; i += 2) {
        sum += term;
        term *= cosine * cosine * (i + 1) / (i + 2);
    }
    return odd ? 2.0 / std::numbers::pi * (theta + std::sin(theta) * sum) : std::sin(theta) * sum;
}

}  // namespace

double normal_share(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

double normal_quantile(double share) {
    if (!(share >= 0.0 && share <= 1.0)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    if (share == 0.0 || share == 1.0) {
        return share == 0.0 ? -kInfinity : kInfinity;
    }
    if (share > 0.5) {
        return -normal_quantile(1.0 - share);
    }
    // The share's logarithm is concave in z, and so Newton's steps from the left never overshoot:
    // the density alone would give this z. Beyond 38 shares have no double.
    double z = -std::min(std::sqrt(-2.0 * std::log(share)), 38.0);
    for (int step = 0; step < 100; ++step) {
        const double below = normal_share(z);
        const double change = below * (std::log(below) - std::log(share)) / normal_density(z);
        z -= change;
        if (std::abs(change) <= 1e-14 * (1.0 + std::abs(z))) {
            break;
        }
    }
    return z;
}

double student_quantile(double share, unsigned degrees_of_freedom) {
    if (!(share >= 0.5 && share < 1.0)) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    const double within = 2.0 * share - 1.0;
    double low = 0.0;
    double high = 1.0;
    while (student_within(high, degrees_of_freedom) < within && high < 1e16) {
        low = high;
        high *= 2.0;
    }
    for (int halving = 0; halving < 100 && high - low > 1e-12 * high; ++halving) {
        const double middle = 0.5 * (low + high);
        (student_within(middle, degrees_of_freedom) < within ? low : high) = middle;
    }
    return 0.5 * (low + high);
}

}  // namespace gazeloop::statistics
