#pragma once

#include "runtime/error.h"
#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::mesh {

/// Holds a scene to what MeshData promises: indices refer to what is there, numbers are finite and
/// in their ranges, textures have the bytes that their sizes ask for. Errors (BadInput): the first
/// thing that is not so, by its place and number.
[[nodiscard]] Expected<void> check_mesh_data(const MeshData& data);

}  // namespace gazeloop::scene::mesh
