#pragma once

#include <cstdint>
#include <span>

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::gltf {

/// Gives every vertex of each triangle the triangle's normal; (0, 0, 1) where it has no area.
/// Precondition: no vertex is shared.
void make_flat_normals(std::span<mesh::Vertex> vertices, std::span<const std::uint32_t> triangles);

/// Makes normals unit. Those without a direction become the mean of their triangles' normals,
/// weighted by area, or (0, 0, 1). Returns how many had none.
std::size_t make_unit_normals(std::span<mesh::Vertex> vertices,
                              std::span<const std::uint32_t> triangles);

/// Tangents along increasing u of `uv[uv_slot]`, the mean of a vertex' triangles weighted by their
/// angle there, perpendicular to its normal; w is the sign of most. Any perpendicular one where a
/// vertex' texture coordinates span nothing.
void make_tangents(std::span<mesh::Vertex> vertices, std::span<const std::uint32_t> triangles,
                   std::size_t uv_slot);

/// Some unit vector perpendicular to a unit vector.
[[nodiscard]] glm::vec3 perpendicular_to(glm::vec3 unit);

}  // namespace gazeloop::scene::gltf
