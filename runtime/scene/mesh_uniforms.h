#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene {

// What the shaders of mesh scenes read, std140.

/// shaders/mesh/view.glsl.
struct ViewUniforms {
    glm::mat4 clip_from_world{1.0F};
    glm::vec4 camera{0.0F};
    std::array<glm::vec4, 3> axes{};
    glm::vec4 tangents{0.0F};
    glm::vec4 size{0.0F};
    glm::vec4 to_sun{0.0F};
    glm::vec4 sun{0.0F};
};
static_assert(sizeof(ViewUniforms) == 16 * std::size_t{4 + 8});

/// shaders/mesh/material.glsl.
struct MaterialUniforms {
    glm::vec4 base_color{1.0F};
    glm::vec4 factors{0.0F};
    glm::vec4 emissive{0.0F};
    glm::vec4 more{0.0F};
    std::array<glm::vec4, 10> transforms{};
};
static_assert(sizeof(MaterialUniforms) == 16 * std::size_t{14});

inline constexpr std::size_t kMostLights = 16;
inline constexpr std::size_t kMostShadowMaps = 8;
/// Texels of a shadow map a side.
inline constexpr std::uint32_t kShadowTexels = 2048;
/// Depth of a G-buffer is this over the distance along the view's axis.
inline constexpr float kNear_m = 0.05F;

/// shaders/scenes/mesh.glsl.
struct LightUniforms {
    glm::vec4 place{0.0F};
    glm::vec4 axis{0.0F};
    glm::vec4 color{0.0F};
    glm::vec4 shape{0.0F};
};
struct MeshUniforms {
    std::array<LightUniforms, kMostLights> lights{};
    std::array<glm::mat4, kMostShadowMaps> shadow_from_world{};
    std::array<glm::vec4, kMostShadowMaps> shadow_texels{};
    std::array<glm::vec4, 9> sky_diffuse{};
    glm::vec4 more{0.0F};
};
static_assert(sizeof(MeshUniforms) == 16 * (4 * kMostLights + 5 * kMostShadowMaps + 10));

/// constant_id of the specialization constants of shaders/scenes/mesh.glsl.
enum MeshConstantId : std::uint32_t {
    kShadowLights = 16,
    kPlainLights = 17,
    kHasGlass = 18,
    kReflectionSteps = 19,
    kOcclusionTaps = 20,
    kFootprint = 21
};

/// Kinds of a G-buffer's texel (shaders/lib/g_buffer.glsl).
enum class TexelKind : std::uint8_t { Unlit, Surface, Glass, Veil };

[[nodiscard]] TexelKind kind_of(const mesh::Material& material);

/// In the order of the bindings and of MaterialUniforms::transforms.
[[nodiscard]] std::array<const mesh::TextureUse*, 5> textures_of(const mesh::Material& material);

[[nodiscard]] MaterialUniforms uniforms_of(const mesh::Material& material);
/// Without its shadow map.
[[nodiscard]] LightUniforms uniforms_of(const mesh::Light& light);

}  // namespace gazeloop::scene
