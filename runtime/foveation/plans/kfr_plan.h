#pragma once

#include "runtime/foveation/log_polar/log_polar_map.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/foveation/plans/log_polar_method_plan.h"

namespace gazeloop::foveation {

/// Plans an eye's picture by KFR. Reuses the plan's memory, which no gaze makes grow.
///
/// The plan has exactly the texels that are read, rounded out to whole bands of kBandRows rows. A
/// texel is read if the bilinear read of some pixel centre outside the disc's unblended core
/// touches it. `hidden` must be of this picture: only visible pixels count (up to their convex
/// hull). Null: all count.
void plan_kfr(const KfrParameters& parameters, LpSize lp, ImageSize image,
              const gaze::PixelPosition& fovea, LogPolarPlan& plan,
              const HiddenArea* hidden = nullptr);

/// The column, as a share of the width, inside which the disc of such a plan covers all; negative:
/// there is no disc.
[[nodiscard]] double core_u(const LogPolarMap& map, const LogPolarPlan& plan);

/// Kernel foveated rendering (Meng et al. 2018), for pictures whose sizes may differ.
class KfrPlan final : public LogPolarMethodPlan {
  public:
    explicit KfrPlan(const KfrParameters& parameters) : parameters_(parameters) {}

    [[nodiscard]] bool fits(const gaze::StereoView& views) const override;
    Expected<void> prepare(const gaze::StereoView& views) override;
    void plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
              const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const override;

    /// The column, as a share of the width, of what lies so far from the fovea. Precondition:
    /// prepare().
    [[nodiscard]] double column_share(gaze::Eye eye, const gaze::FoveaPoint& fovea,
                                      double radius_px) const {
        return LogPolarMap(parameters_.kernel, images_[gaze::index(eye)], fovea.position)
            .u(radius_px);
    }

    [[nodiscard]] bool in_gaze_frame() const override { return false; }
    [[nodiscard]] LpSize lp(gaze::Eye eye) const override { return lp_[gaze::index(eye)]; }
    [[nodiscard]] MapTables tables(gaze::Eye eye) const override {
        return build_map_tables(parameters_.kernel, lp(eye));
    }

  private:
    KfrParameters parameters_;
    gaze::PerEye<ImageSize> images_{};
    gaze::PerEye<LpSize> lp_{};
};

}  // namespace gazeloop::foveation
