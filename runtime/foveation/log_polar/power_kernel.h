#pragma once

#include <cmath>

namespace gazeloop::foveation {

/// The kernel K(x) = x^alpha of kernel foveated rendering (Meng et al. 2018, Eq. 9) on [0, 1],
/// variant B. Larger alpha gives the periphery a larger share of the LP-buffer.
struct PowerKernel {
    static constexpr double kMinAlpha = 0.25;
    static constexpr double kMaxAlpha = 16.0;

    double alpha = 4.0;  ///< in [kMinAlpha, kMaxAlpha]

    [[nodiscard]] double operator()(double x) const { return std::pow(x, alpha); }
    [[nodiscard]] double inverse(double y) const { return std::pow(y, 1.0 / alpha); }
    /// dK/dx; infinite at 0 for alpha < 1.
    [[nodiscard]] double derivative(double x) const { return alpha * std::pow(x, alpha - 1.0); }
};

/// Variant A: the paper's Eq. 10 as printed, which exchanges K and its inverse. It contradicts the
/// paper's own figures and released code. It is here so that the difference can be measured.
struct PrintedPowerKernel {
    double alpha = 4.0;  ///< as PowerKernel

    [[nodiscard]] double operator()(double x) const { return std::pow(x, 1.0 / alpha); }
    [[nodiscard]] double inverse(double y) const { return std::pow(y, alpha); }
    /// dK/dx; infinite at 0 for alpha > 1.
    [[nodiscard]] double derivative(double x) const {
        return std::pow(x, 1.0 / alpha - 1.0) / alpha;
    }
};

}  // namespace gazeloop::foveation
