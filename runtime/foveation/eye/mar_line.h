#pragma once

#include "runtime/error.h"

namespace gazeloop::foveation {

/// How the minimum angle of resolution, in degrees per cycle, rises with eccentricity e:
///     omega(e) = m e + omega0
/// (Guenter et al. 2012, section 3).
struct MarLine {
    /// The lines that are accepted. The least slope is as good as flat: over 180 degrees it rises
    /// by less than a hundredth of 1/48. The greatest makes one cycle as wide as its eccentricity.
    /// At the fovea, 1e-4 degrees per cycle is a hundred times finer than an eye's optics; 10
    /// leaves a few blobs in the field. AcuityProfile checks whether a line asks for more texels
    /// than a device holds.
    static constexpr double kMinSlope = 1e-6;
    static constexpr double kMaxSlope = 1.0;
    static constexpr double kMinOmega0Deg = 1e-4;
    static constexpr double kMaxOmega0Deg = 10.0;

    double slope = 0.022;            ///< m, degrees per cycle per degree; usable .022 to .034
    double omega0_deg = 1.0 / 48.0;  ///< at the fovea, degrees per cycle

    [[nodiscard]] double omega_deg(double eccentricity_deg) const {
        return slope * eccentricity_deg + omega0_deg;
    }
};

/// Errors (Usage): slope or omega0 out of range or not a number; with the value and the range.
Expected<void> check_mar_line(const MarLine& line);

}  // namespace gazeloop::foveation
