#pragma once

#include "runtime/foveation/plans/method_plan.h"

namespace gazeloop::foveation {

/// Full resolution: one grid, the picture's pixels. All of them that the eye can see are shaded.
class FullPlan final : public MethodPlan {
  public:
    [[nodiscard]] const frame::GridList& grids() const override {
        static const frame::GridList kGrids{"picture"};
        return kGrids;
    }
    [[nodiscard]] bool fits(const gaze::StereoView& /*views*/) const override { return true; }
    Expected<void> prepare(const gaze::StereoView& /*views*/) override { return {}; }
    void plan(gaze::Eye /*eye*/, const gaze::EyeView& view, const gaze::FoveaPoint& /*fovea*/,
              const HiddenArea* hidden, const FrameInRun& /*frame*/, EyePlan& plan) const override {
        plan.grids.resize(1);
        frame::GridCounts& counts = plan.grids[0].counts;
        counts = {};
        counts.planned = std::uint64_t{view.width_px} * view.height_px;
        counts.hidden = hidden != nullptr ? hidden->hidden_pixels() : 0;
        counts.shaded = counts.planned - counts.hidden;
    }
};

}  // namespace gazeloop::foveation
