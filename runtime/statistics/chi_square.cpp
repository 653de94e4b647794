#include "runtime/statistics/chi_square.h"

#include <cmath>
#include <limits>

namespace gazeloop::statistics {
namespace {

constexpr double kEnough = 1e-16;

/// P(a, x) by its series, for x < a + 1, where it converges fast.
double lower_by_series(double a, double x, double scale) {
    double term = 1.0 / a;
    double sum = term;
    for (double n = a + 1.0; term > kEnough * sum; n += 1.0) {
        term *= x / n;
        sum += term;
    }
    return sum * scale;
}

/// Q(a, x) by its continued fraction, for x >= a + 1 (Lentz's method).
double upper_by_fraction(double a, double x, double scale) {
    constexpr double kTiny = std::numeric_limits<double>::min();
    double b = x + 1.0 - a;
    double c = 1.0 / kTiny;
    double d = 1.0 / b;
    double fraction = d;
    double change = 0.0;
    for (double n = 1.0; std::abs(change - 1.0) > kEnough && n < 10'000.0; n += 1.0) {
        const double numerator = n * (a - n);
        b += 2.0;
        d = numerator * d + b;
        d = 1.0 / (std::abs(d) < kTiny ? kTiny : d);
        c = b + numerator / c;
        c = std::abs(c) < kTiny ? kTiny : c;
        change = d * c;
        fraction *= change;
    }
    return fraction * scale;
}

}  // namespace

double chi_square_tail(double value, unsigned degrees_of_freedom) {
    if (std::isnan(value)) {
        return value;
    }
    if (value <= 0.0) {
        return 1.0;
    }
    if (std::isinf(value)) {
        return 0.0;
    }
    const double a = 0.5 * degrees_of_freedom;
    const double x = 0.5 * value;
    const double scale = std::exp(a * std::log(x) - x - std::lgamma(a));
    return x < a + 1.0 ? 1.0 - lower_by_series(a, x, scale) : upper_by_fraction(a, x, scale);
}

}  // namespace gazeloop::statistics
