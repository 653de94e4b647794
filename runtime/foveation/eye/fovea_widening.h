#pragma once

#include "runtime/foveation/eye/acuity_model.h"
#include "runtime/gaze/gaze_uncertainty.h"

namespace gazeloop::foveation {

using gaze::bias95_deg;
using gaze::GazeUncertainty;
using gaze::kMaxWideningDeg;
using gaze::widening_deg;

/// What the eye may see when it looks up to `widening_deg` (D) away from the assumed gaze. At
/// eccentricity e this is the cut-off of `model` at max(0, e - D).
class WidenedAcuity final : public AcuityModel {
  public:
    /// `model` must outlive this. Precondition: 0 <= widening_deg <= kMaxWideningDeg.
    WidenedAcuity(const AcuityModel& model, double widening_deg)
        : model_(model), widening_deg_(widening_deg) {}

    [[nodiscard]] std::string_view name() const override { return model_.name(); }
    [[nodiscard]] double cutoff_cpd(double eccentricity_deg, double nasal) const override;

  private:
    const AcuityModel& model_;
    double widening_deg_;
};

/// The eccentricity up to which the display, not the eye, is the limit. It is the greatest one, up
/// to 180 degrees, at which the model asks for at least `display_per_deg` (p) samples per degree. 0
/// if there is none. For Guenter's line: (2 / p - omega0) / m. Precondition: display_per_deg > 0.
[[nodiscard]] double display_limit_deg(const AcuityModel& model, double display_per_deg,
                                       double nasal);

}  // namespace gazeloop::foveation
