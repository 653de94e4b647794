#pragma once

#include <vector>

#include "runtime/foveation/log_polar/radial_kernel.h"

namespace gazeloop::foveation {

/// One of every kind, and the ends of their parameters: what holds for all kernels is tested on
/// these.
inline std::vector<RadialKernel> every_kernel() {
    std::vector<RadialKernel> kernels;
    for (const double alpha : {0.25, 1.0, 4.0, 16.0}) {
        kernels.emplace_back(alpha);
        kernels.emplace_back(PrintedPowerKernel{alpha});
    }
    const std::vector<std::vector<double>> polynomials{
        {1.0}, {0.0, 1.0}, {0.25, 0.25, 0.5}, {3.0, -3.0, 1.0}, {0.0, 3.0, -2.0}, {2.0, -1.0}};
    for (const std::vector<double>& coefficients : polynomials) {
        kernels.emplace_back(value_or_throw(PolynomialKernel::create(coefficients)));
    }
    kernels.emplace_back(SineKernel{});
    kernels.emplace_back(ExponentialKernel{});
    const std::vector<std::vector<TableKernel::Sample>> tables{
        {{0, 0}, {1, 1}},
        {{0, 0}, {0.5, 0.05}, {0.8, 0.4}, {1, 1}},
        {{0, 0}, {0.3, 0.3 + 1e-9}, {0.3 + 1e-9, 0.9}, {1, 1}}};
    for (const std::vector<TableKernel::Sample>& samples : tables) {
        kernels.emplace_back(TableKernel::create(samples).value());
    }
    return kernels;
}

}  // namespace gazeloop::foveation
