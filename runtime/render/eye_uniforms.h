#pragma once

#include <array>
#include <cstdint>
#include <glm/vec4.hpp>

#include "runtime/foveation/plans/sampling_plan.h"
#include "runtime/gaze/view.h"

namespace gazeloop::render {

inline constexpr std::uint32_t kMaxSamples = 16;

/// What every pass knows of one eye's picture; std140, the shader's side is shaders/lib/frame.glsl.
struct EyeUniforms {
    glm::vec4 camera_and_time{0.0F};
    std::array<glm::vec4, 3> view_axes{};
    glm::vec4 tangents{0.0F};
    glm::vec4 image_and_bands{0.0F};
    glm::vec4 fovea_and_log2{0.0F};
    glm::vec4 lp_and_disc{0.0F};
    glm::vec4 radius{0.0F};
    foveation::GazeFrameUniforms gaze_frame{};
    std::array<glm::vec4, kMaxSamples> offsets{};
};
static_assert(sizeof(EyeUniforms) == 16 * std::size_t{15 + kMaxSamples});

/// Sample positions in a cell, in (-.5, .5), mean 0: the centre for one sample, else the Hammersley
/// set. `samples` in [1, kMaxSamples].
[[nodiscard]] std::array<glm::dvec2, kMaxSamples> sample_offsets(std::uint32_t samples);

/// The uniforms of an eye's picture. The plan may be null: full resolution has none.
[[nodiscard]] EyeUniforms eye_uniforms(const gaze::EyeView& view, double scene_time_s,
                                       std::uint32_t samples, const foveation::SamplingPlan* plan);

}  // namespace gazeloop::render
