#pragma once

#include <cstddef>
#include <cstdint>

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::gallery {

/// Materials of objects: [0, object_materials()), from diffuse to mirror and glass.
[[nodiscard]] std::size_t object_materials();
[[nodiscard]] std::uint32_t ground_material();

/// Sets a scene's materials and images. Precondition: it has none.
void add_materials(mesh::MeshData& data);

}  // namespace gazeloop::scene::gallery
