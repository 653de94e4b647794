#pragma once

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::gallery {

/// Objects in a row; there are as many rows.
inline constexpr std::uint32_t kObjectsInRow = 20;
/// Triangles of an object's finest form.
inline constexpr std::uint32_t kFinestTriangles = 20000;

/// The built-in scene of meshes, as Guenter et al. 2012 set theirs up: 20 x 20 parametric objects
/// of up to 20,000 triangles on a terrain of 20,000, under a sky. Materials go from diffuse to
/// mirror and glass. Made to be seen from near the world's origin, 1.4 m above the ground. Always
/// the same.
[[nodiscard]] mesh::MeshData gallery_scene();

}  // namespace gazeloop::scene::gallery
