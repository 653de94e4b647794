#pragma once

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::gallery {

/// Height of the ground in world, m: nearly even where the objects stand, hills far away.
[[nodiscard]] double ground_m(double x_m, double z_m);

/// Appends the ground, 20,000 triangles in tiles, finer near the origin.
void add_terrain(std::uint32_t material, mesh::MeshData& data);

}  // namespace gazeloop::scene::gallery
