#pragma once

#include <memory>
#include <string_view>

#include "runtime/scene/mesh/mesh_data.h"
#include "runtime/scene/scenes.h"

namespace gazeloop::scene {

/// The shader of scenes of meshes: no scene by itself.
inline constexpr std::string_view kMeshShader = "mesh";

/// A scene of meshes by deferred shading: surfaces are drawn into a G-buffer of the picture's size
/// before the gaze is known, and lit afterwards where the method samples. Throws SetupError: broken
/// data (BadInput), no memory (NoDevice).
[[nodiscard]] std::unique_ptr<Scene> make_mesh_scene(const vulkan::Context& context,
                                                     const mesh::MeshData& data,
                                                     const SceneOptions& options);

}  // namespace gazeloop::scene
