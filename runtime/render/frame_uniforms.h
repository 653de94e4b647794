#pragma once

#include <array>
#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec4.hpp>

#include "runtime/gaze/view.h"

namespace gazeloop::render {

/// Most samples per texel or pixel.
inline constexpr std::uint32_t kMaxSamples = 16;

/// What every pass knows of one eye's picture, whatever the scene and method; std140. The shader's
/// side is shaders/lib/frame.glsl.
struct FrameUniforms {
    glm::vec4 camera_and_time{0.0F};
    std::array<glm::vec4, 3> view_axes{};
    glm::vec4 tangents{0.0F};
    glm::vec4 image{0.0F};
    glm::vec4 last_camera{0.0F};
    std::array<glm::vec4, 3> last_view_axes{};
    glm::vec4 last_tangents{0.0F};
    std::array<glm::vec4, kMaxSamples> offsets{};
};
static_assert(sizeof(FrameUniforms) == 16 * std::size_t{11 + kMaxSamples});

/// Sample positions in a cell, in (-.5, .5), mean 0: the centre for one sample, else the Hammersley
/// set. `samples` in [1, kMaxSamples].
[[nodiscard]] std::array<glm::dvec2, kMaxSamples> sample_offsets(std::uint32_t samples);

/// The uniforms of an eye's picture. `last`: the same eye's view in the last frame; null: there is
/// none. `aside`: how far samples are moved in their cells, in (-.5, .5) each.
[[nodiscard]] FrameUniforms frame_uniforms(const gaze::EyeView& view, double scene_time_s,
                                           std::uint32_t samples, const gaze::EyeView* last,
                                           const glm::dvec2& aside = {});

}  // namespace gazeloop::render
