#pragma once

#include "runtime/foveation/log_polar/acuity_map.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/foveation/plans/log_polar_method_plan.h"
#include "runtime/foveation/plans/prepared_views.h"

namespace gazeloop::foveation {

/// Plans an eye's picture by the acuity-derived map. `gaze` in the view frame (gaze::FoveaPoint's
/// direction), of any length and direction. Reuses the plan's memory, which no gaze makes grow.
///
/// As in plan_kfr, the plan has exactly the texels that are read, rounded out to whole bands of
/// kBandRows rows. A texel is read if the bilinear read of some pixel centre outside the disc's
/// unblended core touches it. The disc is the circle of eccentricity
/// AcuityMap::disc_eccentricity_deg, at least e_c + `widening_deg` (D, 0 or more): every place
/// where the eye may look, and around it what only the display limits. So it costs nothing while
/// the disc is wider than the eye asks for; beyond the disc the density stays that of D = 0. There
/// is none without parameters.disc. The blend's border is border_px wide, in pixels at the gaze.
/// `hidden` must be of this picture: only visible pixels count (up to their convex hull). Null: all
/// count.
void plan_acuity(const AcuityParameters& parameters, const AcuityProfile& profile,
                 const gaze::EyeView& view, const glm::dvec3& gaze, LogPolarPlan& plan,
                 const HiddenArea* hidden = nullptr, double widening_deg = 0.0);

/// The acuity-derived map, made for one pair of fields of view.
class AcuityPlan final : public LogPolarMethodPlan {
  public:
    explicit AcuityPlan(const AcuityParameters& parameters) : parameters_(parameters) {}

    [[nodiscard]] bool fits(const gaze::StereoView& views) const override;
    Expected<void> prepare(const gaze::StereoView& views) override;
    void plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
              const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const override;

    [[nodiscard]] bool in_gaze_frame() const override { return true; }
    [[nodiscard]] LpSize lp(gaze::Eye eye) const override {
        return profiles_[gaze::index(eye)]->lp();
    }
    [[nodiscard]] MapTables tables(gaze::Eye eye) const override {
        return build_map_tables(*profiles_[gaze::index(eye)]);
    }

  private:
    AcuityParameters parameters_;
    gaze::PerEye<std::optional<AcuityProfile>> profiles_;
    PreparedViews prepared_;
};

}  // namespace gazeloop::foveation
