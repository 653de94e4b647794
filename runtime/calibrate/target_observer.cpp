#include "runtime/calibrate/target_observer.h"

#include <array>
#include <glm/gtc/quaternion.hpp>

namespace gazeloop::calibrate {
namespace {

/// Of the picture's shorter side: the dot, and what sets it off from any scene. About 3 and 1 deg
/// of a picture that is 100 deg wide.
constexpr double kGroundShare = 0.03;
constexpr double kDotShare = 0.01;

}  // namespace

void TargetObserver::on_sample(const gaze::GazeSample& sample, std::uint64_t /*frame*/) {
    samples_->add(sample);
}

void TargetObserver::on_rendered(const render::FrameView& view, const gaze::FrameFovea& /*fovea*/) {
    start_s_ = start_s_.value_or(view.scene_time_s);
    const double seconds = view.scene_time_s - *start_s_;
    samples_->set_time(seconds);
    const auto shown = schedule_.at(seconds);
    if (!shown) {
        return;
    }
    const glm::dquat head =
        glm::slerp(view.views[0].pose.orientation, view.views[1].pose.orientation, 0.5);
    std::array<probe::PatchPainter::Patch, 2> patches{};
    patches[1].light = 1.0F;
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        const glm::dvec3 in_view =
            glm::conjugate(view.views[eye].pose.orientation) * (head * targets_[shown->target]);
        patches[0].areas[eye] = probe::patch_area(view.views[eye], in_view, kGroundShare);
        patches[1].areas[eye] = probe::patch_area(view.views[eye], in_view, kDotShare);
    }
    painter_.paint(view, patches);
}

}  // namespace gazeloop::calibrate
