#pragma once

#include <array>
#include <glm/vec4.hpp>

#include "runtime/foveation/plans/layered_plan.h"
#include "runtime/gaze/view.h"

namespace gazeloop::render {

/// A layer as it was shaded last; std140, shaders/lib/layers.glsl. That of no layer: it holds
/// nothing.
struct SeenLayer {
    glm::vec4 covers{0.0F, 0.0F, 1.0F, 1.0F};
    glm::vec4 cells{0.0F};
    glm::vec4 blend{0.0F};
    glm::vec4 gaze{0.0F};
    glm::vec4 camera{0.0F};
    std::array<glm::vec4, 3> axes{};
    glm::vec4 tangents{-1.0F, 1.0F, 1.0F, -1.0F};
};

/// What the shaders are told of an eye's layers; std140, as above.
struct LayerUniforms {
    std::array<SeenLayer, foveation::LayeredPlan::kMostLayers> shown{};
    std::array<SeenLayer, foveation::LayeredPlan::kMostLayers> before{};
    glm::vec4 first_band{0.0F};
};

/// A layer of this frame's plan as this view sees it, its samples in the middle of their cells.
[[nodiscard]] SeenLayer seen_now(const gaze::EyeView& view, const foveation::EyePlan& plan,
                                 const foveation::LayeredPlan::Layer& planned);

}  // namespace gazeloop::render
