#pragma once

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::gltf {

/// Moves a scene to where its viewer starts: eyes at the origin, looking along -Z, upright.
///
/// The first viewpoint of the scene (a camera of the file) is the viewer's place and heading; its
/// pitch and roll are left out, since the head has its own. Without one the viewer stands in front
/// of everything (glTF's front is +Z), at half its height and at the least distance from which all
/// of it lies within 90 degrees. Precondition: there is an instance.
void place_before_viewer(mesh::MeshData& data);

}  // namespace gazeloop::scene::gltf
