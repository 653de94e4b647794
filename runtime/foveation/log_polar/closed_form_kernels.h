#pragma once

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gazeloop::foveation {

/// K(x) = sin(x pi/2) (Meng et al. 2018, section 3.2). Its slope is 0 at 1: the outermost columns
/// are wide.
struct SineKernel {
    [[nodiscard]] double operator()(double x) const { return std::sin(x * std::numbers::pi / 2.0); }
    [[nodiscard]] double inverse(double y) const {
        return std::asin(std::min(y, 1.0)) * (2.0 / std::numbers::pi);
    }
    [[nodiscard]] double derivative(double x) const {
        return std::cos(x * std::numbers::pi / 2.0) * (std::numbers::pi / 2.0);
    }
};

/// K(x) = (e^x - 1) / (e - 1) (Meng et al. 2018, section 3.2).
struct ExponentialKernel {
    static constexpr double kReach = std::numbers::e - 1.0;

    [[nodiscard]] double operator()(double x) const {
        return std::min(std::expm1(x) / kReach, 1.0);
    }
    [[nodiscard]] double inverse(double y) const { return std::log1p(y * kReach); }
    [[nodiscard]] double derivative(double x) const { return std::exp(x) / kReach; }
};

}  // namespace gazeloop::foveation
