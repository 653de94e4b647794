#include "runtime/foveation/log_polar/polynomial_kernel.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <ranges>

#include "runtime/foveation/log_polar/monotone_root.h"

namespace gazeloop::foveation {
namespace {

std::unexpected<Error> refuse(std::string message) {
    return std::unexpected(Error{ErrorKind::Usage, std::move(message)});
}

double horner(std::span<const double> ascending, double x) {
    double value = 0.0;
    for (const double coefficient : std::views::reverse(ascending)) {
        value = value * x + coefficient;
    }
    return value;
}

/// The coefficients in Bernstein's basis on [0, 1], from those of the powers of x:
/// b_j = sum over i <= j of C(j, i) / C(d, i) a_i.
std::vector<double> bernstein(std::span<const double> ascending) {
    const std::size_t degree = ascending.size() - 1;
    std::vector<double> result(ascending.size(), 0.0);
    for (std::size_t j = 0; j <= degree; ++j) {
        double ratio = 1.0;
        for (std::size_t i = 0; i <= j; ++i) {
            result[j] += ratio * ascending[i];
            if (i < j) {
                ratio *= static_cast<double>(j - i) / static_cast<double>(degree - i);
            }
        }
    }
    return result;
}

/// A place at which a polynomial is less than -tolerance; nothing if it is proven that there is
/// none. The polynomial is given by its Bernstein coefficients on [low, high]. An interval too
/// narrow for doubles to halve is judged by its ends.
std::optional<double> negative_at(const std::vector<double>& coefficients, double low, double high,
                                  double tolerance) {
    if (coefficients.front() < -tolerance) {
        return low;
    }
    if (coefficients.back() < -tolerance) {
        return high;
    }
    const double middle = 0.5 * (low + high);
    if (std::ranges::min(coefficients) >= -tolerance || middle <= low || middle >= high) {
        return std::nullopt;
    }
    // de Casteljau at the middle: the left halves are the first of each row, the right ones the
    // last.
    std::vector<double> left;
    std::vector<double> row = coefficients;
    std::vector<double> right(coefficients.size());
    for (std::size_t n = row.size(); n > 0; --n) {
        left.push_back(row[0]);
        right[n - 1] = row[n - 1];
        for (std::size_t i = 0; i + 1 < n; ++i) {
            row[i] = 0.5 * (row[i] + row[i + 1]);
        }
    }
    if (const auto found = negative_at(left, low, middle, tolerance)) {
        return found;
    }
    return negative_at(right, middle, high, tolerance);
}

}  // namespace

Expected<PolynomialKernel> PolynomialKernel::create(std::span<const double> coefficients) {
    if (coefficients.empty() || coefficients.size() > kMaxCoefficients) {
        return refuse(fmt::format("a polynomial kernel of {} coefficients: it must have 1 to {}",
                                  coefficients.size(), kMaxCoefficients));
    }
    double sum = 0.0;
    for (std::size_t i = 0; i < coefficients.size(); ++i) {
        if (!(std::abs(coefficients[i]) <= kMaxMagnitude)) {
            return refuse(
                fmt::format("the polynomial kernel's coefficient {} of x^{}: must lie in "
                            "[{}, {}]",
                            coefficients[i], i + 1, -kMaxMagnitude, kMaxMagnitude));
        }
        sum += coefficients[i];
    }
    if (!(std::abs(sum - 1.0) <= kSumTolerance)) {
        return refuse(
            fmt::format("the polynomial kernel's coefficients sum to {}: the sum must "
                        "lie in [{}, {}]",
                        sum, 1.0 - kSumTolerance, 1.0 + kSumTolerance));
    }
    PolynomialKernel kernel(coefficients);
    std::vector<double> slope;
    slope.reserve(kernel.coefficients_.size());
    for (std::size_t i = 0; i < kernel.coefficients_.size(); ++i) {
        slope.push_back(static_cast<double>(i + 1) * kernel.coefficients_[i]);
    }
    const std::vector<double> start = bernstein(slope);
    const double largest = std::ranges::max(start, {}, [](double b) { return std::abs(b); });
    if (const auto x = negative_at(start, 0.0, 1.0, 1e-13 * std::abs(largest))) {
        return refuse(
            fmt::format("the polynomial kernel falls at x = {:.6g}, where its slope is "
                        "{:.6g}: the slope must lie in [0, inf) everywhere on [0, 1]",
                        *x, kernel.derivative(*x)));
    }
    // Rounding may leave a dip, which must not reverse a bracket.
    for (std::size_t i = 1; i <= kNodes; ++i) {
        kernel.nodes_[i] = std::max(kernel.nodes_[i], kernel.nodes_[i - 1]);
    }
    return kernel;
}

PolynomialKernel::PolynomialKernel(std::span<const double> coefficients)
    : coefficients_(coefficients.begin(), coefficients.end()) {
    double sum = 0.0;
    for (const double coefficient : coefficients_) {
        sum += coefficient;
    }
    for (double& coefficient : coefficients_) {
        coefficient /= sum;
    }
    for (std::size_t i = 0; i <= kNodes; ++i) {
        nodes_[i] = (*this)(static_cast<double>(i) / kNodes);
    }
    nodes_.back() = 1.0;
}

double PolynomialKernel::operator()(double x) const {
    // At the ends rounding must not pass them.
    return std::clamp(x * horner(coefficients_, x), 0.0, 1.0);
}

double PolynomialKernel::derivative(double x) const {
    double value = 0.0;
    for (std::size_t i = coefficients_.size(); i > 0; --i) {
        value = value * x + static_cast<double>(i) * coefficients_[i - 1];
    }
    return std::max(value, 0.0);
}

double PolynomialKernel::inverse(double y) const {
    if (y <= 0.0 || y >= 1.0) {
        return y <= 0.0 ? 0.0 : 1.0;
    }
    const auto above = std::ranges::upper_bound(nodes_, y);
    const auto cell = static_cast<double>(
        std::clamp<std::ptrdiff_t>(above - nodes_.begin() - 1, 0, std::ptrdiff_t{kNodes} - 1));
    return monotone_root(
        *this, [this](double x) { return derivative(x); }, cell / kNodes, (cell + 1.0) / kNodes, y);
}

}  // namespace gazeloop::foveation
