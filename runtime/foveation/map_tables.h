#pragma once

#include <array>
#include <cstddef>
#include <vector>

#include "runtime/foveation/log_polar_map.h"

namespace gazeloop::foveation {

/// The float tables that replace transcendental functions in the shaders. They depend on kernel and
/// LP-buffer size only: fovea and L stay uniforms, so that a new gaze rebuilds nothing.
///
/// Errors of the tables as the shader reads them (linear interpolation, |f''| h^2 / 8), as relative
/// error of r: log2 2.4e-7, exp2 2.3e-7; the kernel's table adds r L |K''| / (8 N^2 K'), for
/// alpha = 4 under 2e-7 L of r. Together they stay under .01 px up to r = 4096.
struct MapTables {
    static constexpr std::size_t kMantissaSteps = 512;
    static constexpr std::size_t kKernelSteps = 4096;

    /// log2(1 + i / kMantissaSteps): the piecewise logarithm that a float's own bits index.
    std::array<float, kMantissaSteps + 1> log2_mantissa{};
    /// 2^(i / kMantissaSteps).
    std::array<float, kMantissaSteps + 1> exp2_fraction{};
    /// K(i / kKernelSteps).
    std::array<float, kKernelSteps + 1> kernel{};
    /// K^-1(i / (2 w)): even entries are column edges, odd ones column centres. 2 w + 1 entries.
    std::vector<float> column;
    /// Cosine and sine of the rows' centre angles, (j + .5) 2 pi / h. h entries.
    struct Direction {
        float cosine;
        float sine;
    };
    std::vector<Direction> row;
};

[[nodiscard]] MapTables build_map_tables(const PowerKernel& kernel, LpSize lp);

}  // namespace gazeloop::foveation
