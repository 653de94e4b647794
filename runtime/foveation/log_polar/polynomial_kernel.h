#pragma once

#include <array>
#include <cstddef>
#include <span>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::foveation {

/// K(x) = sum of b_i x^i, i from 1 (Meng et al. 2018, section 3.2). The coefficients must add up to
/// 1, and K must not fall anywhere on [0, 1].
class PolynomialKernel {
  public:
    static constexpr std::size_t kMaxCoefficients = 12;
    static constexpr double kMaxMagnitude = 1000.0;
    /// Coefficients are usually written in decimals, so their sum may differ from 1 by this much.
    /// It is then scaled to 1.
    static constexpr double kSumTolerance = 1e-6;

    /// Errors (Usage), each with the value and the valid range:
    ///  - no coefficient, or more than kMaxCoefficients;
    ///  - a coefficient that is not a number, or larger than kMaxMagnitude;
    ///  - a sum other than 1;
    ///  - a polynomial that falls, with a place where it does.
    ///
    /// That the polynomial does not fall is proven: the derivative's Bernstein coefficients bound
    /// it from below, and the interval is subdivided until they are not negative. A dip of less
    /// than 1e-13 of the largest coefficient is rounding and passes.
    static Expected<PolynomialKernel> create(std::span<const double> coefficients);

    [[nodiscard]] double operator()(double x) const;
    [[nodiscard]] double inverse(double y) const;
    [[nodiscard]] double derivative(double x) const;
    /// As given, b_1 first, scaled to the sum 1.
    [[nodiscard]] const std::vector<double>& coefficients() const { return coefficients_; }

  private:
    static constexpr std::size_t kNodes = 64;

    explicit PolynomialKernel(std::span<const double> coefficients);

    std::vector<double> coefficients_;
    std::array<double, kNodes + 1> nodes_{};  ///< K(i / kNodes): brackets for the inverse
};

}  // namespace gazeloop::foveation
