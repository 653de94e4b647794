#pragma once

#include "runtime/foveation/eye/acuity_model.h"

namespace gazeloop::foveation {

/// The finest gratings of black and white that people resolved (Ashraf, Chapiro and Mantiuk 2025,
/// "Resolution limit of the eye", Nature Communications 16:9086): 94 pixels per degree at the
/// fovea, 2.3 times fewer at 20 degrees. Between, and beyond the 20 degrees that were measured,
/// pixels per degree fall as 1 / (1 + k e).
///
/// It is a limit of contrast in full, for the best of observers' conditions. What lies between it
/// and Guenter's line is detected though not resolved, so it is missed where it is left out.
class ResolutionLimit final : public AcuityModel {
  public:
    static constexpr double kFovealPerDeg = 94.0;
    static constexpr double kFall = 2.3;
    static constexpr double kFallDeg = 20.0;

    [[nodiscard]] std::string_view name() const override { return "ashraf2025"; }
    [[nodiscard]] double cutoff_cpd(double eccentricity_deg, double /*nasal*/) const override {
        return 0.5 * kFovealPerDeg / (1.0 + (kFall - 1.0) / kFallDeg * eccentricity_deg);
    }
};

}  // namespace gazeloop::foveation
