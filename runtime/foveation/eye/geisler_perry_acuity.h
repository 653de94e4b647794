#pragma once

#include "runtime/foveation/eye/acuity_model.h"

namespace gazeloop::foveation {

/// Geisler and Perry 1998, "A real-time foveated multiresolution system for low-bandwidth video
/// communication". The contrast threshold is
///     CT(f, e) = CT0 exp(alpha f (e + e2) / e2).
/// It reaches 1 (full contrast) at the cut-off
///     f = e2 ln(1 / CT0) / (alpha (e + e2)).
///
/// The constants are the ones in common use with this formula. They have not been compared with the
/// printed paper.
class GeislerPerryAcuity final : public AcuityModel {
  public:
    static constexpr double kFovealThreshold = 1.0 / 64.0;  ///< CT0
    static constexpr double kDecay = 0.106;                 ///< alpha
    static constexpr double kHalfResolutionDeg = 2.3;       ///< e2

    [[nodiscard]] std::string_view name() const override { return "geisler-perry"; }
    [[nodiscard]] double cutoff_cpd(double eccentricity_deg, double nasal) const override;
};

}  // namespace gazeloop::foveation
