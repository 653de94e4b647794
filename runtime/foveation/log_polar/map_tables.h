#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

#include "runtime/foveation/log_polar/acuity_profile.h"
#include "runtime/foveation/log_polar/log_polar_map.h"

namespace gazeloop::foveation {

/// The float tables that replace transcendental functions in the shaders (shaders/lib). They depend
/// only on the map and the LP-buffer's size. Fovea, L and the gaze's rotation stay uniforms
/// (map_uniforms.h), so a new gaze rebuilds nothing.
///
/// The shader's forward map takes q: r^2 / rmax^2 (picture frame) or sin^2(e / 2) (gaze frame).
/// Both are at most 1 and need no trigonometry. It reads the forward table at
///     t = sqrt(s),   s = clamp(-log2(q) scale, 0, 1),   scale = .5 / log2 rmax, or kGazeScale.
/// So t = 0 is the screen's far end and t = 1 the fovea. Distances are measured from the far end,
/// because an error e of log2 q moves a pixel by r e ln2 / 2. Floats are finest near 0, where r is
/// greatest. The root does the same for the table's steps. It also removes the infinite slope of
/// the inverse of a kernel with a flat end (sin). The inverse is tabulated at half columns.
///
/// Errors as the shader reads them, by linear interpolation (|f''| h^2 / 8): 2.4e-7 of r for log2
/// and 2.3e-7 of r for exp2. map_error.h derives the forward table's.
struct MapTables {
    static constexpr std::size_t kMantissaSteps = 512;
    static constexpr std::size_t kForwardSteps = 4096;
    /// Octaves of sin(e / 2) that the forward table of the gaze frame spans. At its inner end the
    /// eccentricity is 7e-6 degrees, under a thousandth of a pixel at 100 pixels per degree.
    static constexpr double kGazeOctaves = 24.0;
    static constexpr double kGazeScale = 0.5 / kGazeOctaves;

    /// log2(1 + i / kMantissaSteps): the piecewise logarithm that a float's own bits index.
    std::array<float, kMantissaSteps + 1> log2_mantissa{};
    /// 2^(i / kMantissaSteps).
    std::array<float, kMantissaSteps + 1> exp2_fraction{};
    /// u at t = i / kForwardSteps: falls from 1 to 0.
    std::array<float, kForwardSteps + 1> forward{};
    /// At i / (2 w) of the width, 2 w + 1 entries: even entries are column edges, odd ones column
    /// centres. Picture frame: 1 - K^-1, so that r = rmax 2^(-column log2 rmax). Gaze frame: rho =
    /// tan(e / 2), so that the ray is (2 rho cosine, 2 rho sine, 1 - rho^2).
    std::vector<float> column;
    /// Cosine and sine of the rows' centre angles, (j + .5) 2 pi / h. h entries.
    struct Direction {
        float cosine;
        float sine;
    };
    std::vector<Direction> row;

    /// What the forward table of the gaze frame holds, in double: u at s.
    [[nodiscard]] static double gaze_frame_u(const AcuityProfile& profile, double s);

    /// How far linear interpolation in cell i of the forward table strays from u_at(s), in double.
    /// Taken at three points of the cell, plus a quarter for what lies between them.
    template <typename Function>
    [[nodiscard]] static double interpolation_error(std::size_t i, const Function& u_at) {
        const auto at = [&](double step) {
            const double t = (static_cast<double>(i) + step) / kForwardSteps;
            return u_at(t * t);
        };
        const double low = at(0.0);
        const double high = at(1.0);
        double error = 0.0;
        for (const double step : {0.25, 0.5, 0.75}) {
            error = std::max(error, std::abs(at(step) - (low + step * (high - low))));
        }
        return 1.25 * error;
    }
};

[[nodiscard]] MapTables build_map_tables(const RadialKernel& kernel, LpSize lp);
[[nodiscard]] MapTables build_map_tables(const AcuityProfile& profile);

}  // namespace gazeloop::foveation
