#pragma once

#include <glm/matrix.hpp>
#include <memory>
#include <utility>

#include "runtime/foveation/picture/offered_density.h"
#include "runtime/foveation/plans/method_plan.h"

namespace gazeloop::foveation {

/// The direction that fixed foveation looks in, in the view's frame.
inline constexpr glm::dvec3 kStraightAhead{0.0, 0.0, -1.0};

/// A method's plan with the fovea held straight ahead, whatever the gaze: what there is without eye
/// tracking.
class FixedPlan final : public MethodPlan {
  public:
    /// `held` must outlive this; it is prepared elsewhere.
    explicit FixedPlan(const MethodPlan& held) : held_(held) {}

    [[nodiscard]] const frame::GridList& grids() const override { return held_.grids(); }
    [[nodiscard]] bool fits(const gaze::StereoView& views) const override {
        return held_.fits(views);
    }
    Expected<void> prepare(const gaze::StereoView& /*views*/) override { return {}; }
    [[nodiscard]] gaze::FoveaPoint followed(const gaze::EyeView& view,
                                            const gaze::FoveaPoint& fovea) const override {
        gaze::FoveaPoint ahead = fovea;
        ahead.direction = kStraightAhead;
        ahead.position = gaze::project(kStraightAhead, view);
        return ahead;
    }
    void plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
              const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const override {
        held_.plan(eye, view, followed(view, fovea), hidden, frame, plan);
        plan.ring_px = 0.0;  // it would be drawn around the gaze
    }

  private:
    const MethodPlan& held_;
};

/// What a method offers an eye that looks elsewhere than straight ahead.
class FixedDensity final : public OfferedDensity {
  public:
    /// `ahead`: the field of the same picture, seen straight ahead.
    FixedDensity(std::unique_ptr<OfferedDensity> held, const GazeField& ahead)
        : held_(std::move(held)), ahead_(ahead) {}

    [[nodiscard]] SampleGrid at(const FieldPoint& at) const override {
        const FieldPoint from_ahead = ahead_.at(at.pixel);
        const SampleGrid in_degrees = held_->at(from_ahead);
        const glm::dmat2 degrees_per_px = glm::inverse(from_ahead.px_per_deg);
        return SampleGrid{in_degrees.first * degrees_per_px, in_degrees.second * degrees_per_px}
            .in_degrees(at);
    }

  private:
    std::unique_ptr<OfferedDensity> held_;
    GazeField ahead_;
};

}  // namespace gazeloop::foveation
