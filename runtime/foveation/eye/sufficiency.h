#pragma once

#include <optional>
#include <vector>

#include "runtime/foveation/eye/acuity_model.h"
#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/foveation/picture/offered_density.h"

namespace gazeloop::foveation {

/// Whether a plan offers what a model asks for.
struct Sufficiency {
    /// Least ratio of offered to required samples per degree, over all eccentricities and
    /// directions in the picture. Offered: in the direction that the plan's grid serves worst.
    /// Required: what the model asks for, but no more than the display can show there. 1: enough
    /// everywhere, and just enough somewhere. Infinite if the model asks for nothing in the
    /// picture.
    double least_ratio = 0.0;
    FieldPoint worst;  ///< where that is

    [[nodiscard]] bool sufficient() const { return least_ratio >= 1.0 - kTolerance; }

    /// How much of the ratio may be lost by rounding sizes to whole samples.
    static constexpr double kTolerance = 0.005;
};

/// Checks eccentricities from a fifth of a pixel to the picture's farthest corner, in 144
/// directions. The steps are .25 % or .02 degrees, whichever is more, so a density that jumps is
/// seen within one step of the jump.
[[nodiscard]] Sufficiency check_sufficiency(const GazeField& field, const OfferedDensity& offered,
                                            const AcuityModel& model, gaze::Eye eye);

/// Offered density by eccentricity, for a plot: the least over all directions in the picture.
struct DensityAt {
    double eccentricity_deg = 0.0;
    double per_deg = 0.0;  ///< samples per degree in the worst direction
};

/// At eccentricities from `from_deg` to the picture's farthest corner, evenly spaced by logarithm.
/// Eccentricities that lie in the picture in no direction are left out. Preconditions: from_deg >
/// 0, points >= 2.
[[nodiscard]] std::vector<DensityAt> density_profile(const GazeField& field,
                                                     const OfferedDensity& offered, double from_deg,
                                                     int points);

}  // namespace gazeloop::foveation
