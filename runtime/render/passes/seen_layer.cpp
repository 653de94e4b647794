#include "runtime/render/passes/seen_layer.h"

#include <glm/vec3.hpp>

#include "runtime/render/frame_uniforms.h"

namespace gazeloop::render {

SeenLayer seen_now(const gaze::EyeView& view, const foveation::EyePlan& plan,
                   const foveation::LayeredPlan::Layer& planned) {
    const FrameUniforms frame = frame_uniforms(view, 0.0, 1, nullptr);
    const glm::vec3 gaze = foveation::LayeredPlan::gaze_of(plan);
    const bool any = planned.cells.x > 0.0F && planned.cells.y > 0.0F;
    const glm::vec3 in_world = glm::vec3(frame.view_axes[0]) * gaze.x +
                               glm::vec3(frame.view_axes[1]) * gaze.y +
                               glm::vec3(frame.view_axes[2]) * gaze.z;
    SeenLayer seen{.cells = {planned.cells.x, planned.cells.y, 0.0F, 0.0F},
                   .blend = planned.blend,
                   .gaze = glm::vec4(in_world, any ? 1.0F : 0.0F),
                   .camera = glm::vec4(glm::vec3(frame.camera_and_time), 0.0F),
                   .axes = frame.view_axes,
                   .tangents = frame.tangents};
    if (any) {
        seen.covers = planned.covers;
    }
    return seen;
}

}  // namespace gazeloop::render
