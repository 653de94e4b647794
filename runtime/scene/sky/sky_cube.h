#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::sky {

/// Radiance of a sky in a direction (unit, world), without the sun's disc; finite, not negative.
[[nodiscard]] glm::vec3 radiance(const mesh::Sky& sky, const glm::vec3& direction);

/// The direction that a place of a cube map's face shows: faces and axes as Vulkan's, s and t in
/// [0, 1] from the top left. Not normalised.
[[nodiscard]] glm::vec3 cube_direction(std::uint32_t face, float s, float t);

/// A sky as a cube map whose levels are blurred for mirrors of rising roughness: level l of n is
/// seen by a surface of GGX roughness l / (n - 1), after Karis 2013 (view along the normal).
struct SkyCube {
    static constexpr std::uint32_t kFace = 256;  ///< texels a side, level 0
    static constexpr std::uint32_t kLevels = 6;
    static constexpr std::uint32_t face_of(std::uint32_t level) { return kFace >> level; }

    /// Of each level the six faces, one after the other, rows from the top.
    std::array<std::vector<glm::vec3>, kLevels> levels;
    /// What a diffuse surface receives, divided by pi: nine coefficients of real spherical
    /// harmonics (order 1, y z x, xy yz 3zz-1 xz xx-yy), the cosine lobe's weights multiplied in
    /// (Ramamoorthi and Hanrahan 2001), so that their sum at a normal is the radiance of white.
    std::array<glm::vec3, 9> diffuse{};
};

[[nodiscard]] SkyCube bake(const mesh::Sky& sky);

/// The diffuse radiance that a SkyCube's coefficients give at a normal.
[[nodiscard]] glm::vec3 diffuse_at(const std::array<glm::vec3, 9>& coefficients,
                                   const glm::vec3& normal);

}  // namespace gazeloop::scene::sky
