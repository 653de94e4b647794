#pragma once

namespace gazeloop::foveation {

/// The line that the minimum angle of resolution follows with eccentricity, in degrees per cycle:
///     omega(e) = m e + omega0
/// (Guenter et al. 2012, section 3).
struct MarLine {
    double slope = 0.022;            ///< m, degrees per cycle and degree; > 0, usable .022 to .034
    double omega0_deg = 1.0 / 48.0;  ///< at the fovea, degrees per cycle; > 0

    [[nodiscard]] double omega_deg(double eccentricity_deg) const {
        return slope * eccentricity_deg + omega0_deg;
    }
};

}  // namespace gazeloop::foveation
