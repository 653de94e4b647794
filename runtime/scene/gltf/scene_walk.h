#pragma once

#include <glm/mat4x3.hpp>
#include <vector>

#include "runtime/scene/gltf/document.h"

namespace gazeloop::scene::gltf {

/// A mesh of the file at a place in the world.
struct PlacedMesh {
    std::uint32_t mesh = 0;
    glm::mat4x3 world_from_local{1.0F};
};

/// What the shown scene's nodes hold, in world.
struct ShownNodes {
    std::vector<PlacedMesh> meshes;
    std::vector<mesh::Light> lights;
    std::vector<mesh::Viewpoint> viewpoints;
};

/// Walks the trees of the shown scene. Refuses placements beyond single precision; nodes that are
/// scaled to nothing are left out, noted.
[[nodiscard]] ShownNodes walk_scene(const Document& document, Notes& notes);

}  // namespace gazeloop::scene::gltf
