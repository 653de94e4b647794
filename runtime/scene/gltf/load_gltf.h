#pragma once

#include <cstddef>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/error.h"
#include "runtime/scene/gltf/load_limits.h"
#include "runtime/scene/gltf/resource.h"
#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::gltf {

struct LoadOptions {
    LoadLimits limits{};
    /// A picture that is missing or cannot be decoded: shown as magenta and black, and noted,
    /// instead of refusing the file.
    bool mark_broken_pictures = false;
    bool coarser_forms = true;  ///< makes the levels of detail
    unsigned threads = 0;       ///< that decode; 0: as many as the machine has
    /// Told of each part (a picture, a shape) that is done, from any of those threads, one at a
    /// time.
    std::function<void(std::size_t done, std::size_t total)> progress{};
};

struct LoadedScene {
    mesh::MeshData data;
    std::vector<Note> notes;  ///< what the user should know of the file
};

/// Loads the default scene of a .gltf or .glb file (glTF 2.0). Nodes are flattened to instances,
/// shapes that are equal are made once, of pictures only those that something shown uses are
/// decoded. Errors (BadInput): the file, the place in it as a JSON pointer, what is wrong, the
/// remedy.
[[nodiscard]] Expected<LoadedScene> load_gltf(const std::filesystem::path& file,
                                              const LoadOptions& options = {});

/// The same of bytes in memory; `name` is for messages.
[[nodiscard]] Expected<LoadedScene> load_gltf(std::span<const std::byte> file,
                                              const std::string& name, const ReadFile& read_file,
                                              const LoadOptions& options = {});

/// For people: "PLACE: text (and 3 more)".
[[nodiscard]] std::string note_text(const Note& note);

}  // namespace gazeloop::scene::gltf
