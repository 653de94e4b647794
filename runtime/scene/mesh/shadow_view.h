#pragma once

#include <array>
#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec4.hpp>
#include <vector>

#include "runtime/scene/mesh/draw_list.h"
#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::mesh {

/// What one shadow map is drawn from. Depth falls with distance from the light: 1 nearest, 0
/// farthest; x and y of the clip are the map's, -1 to 1, y down.
struct ShadowView {
    glm::mat4 clip_from_world{1.0F};
    Frustum frustum;
    /// Width of a texel: at any distance, and per metre from the light.
    float texel_m = 0.0F;
    float texel_per_m = 0.0F;
};

/// The shadow maps of a light: of a directional one a fine map around `near_m` (a point and a
/// radius) and a wide one around `all_m`, of a spot one. Point lights have none. Lengths in m,
/// `texels` per side.
[[nodiscard]] std::vector<ShadowView> shadow_views(const Light& light, const glm::vec4& near_m,
                                                   const glm::vec4& all_m, std::uint32_t texels);

}  // namespace gazeloop::scene::mesh
