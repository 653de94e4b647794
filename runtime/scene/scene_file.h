#pragma once

#include <array>
#include <filesystem>
#include <string_view>

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene {

/// What the names of scene files end in, in lower case.
inline constexpr std::array<std::string_view, 2> kSceneFileExtensions{".gltf", ".glb"};

/// Whether a scene's name is that of a file.
[[nodiscard]] bool is_scene_file(std::string_view name);

/// Loads a scene from a file, and moves it to where its viewer starts: at the file's first camera,
/// else in front of everything (gltf/viewer_place.h). What the user should know of it is logged as
/// warnings. While it takes long, stderr says how far it is: on a terminal in one line that goes
/// again, else every 2 s; not where the log is below information. Throws SetupError (BadInput).
[[nodiscard]] mesh::MeshData load_scene_file(const std::filesystem::path& file);

}  // namespace gazeloop::scene
