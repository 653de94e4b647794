#pragma once

#include <string>
#include <vector>

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene {

/// What a scene of meshes asks of its renderer: what it does not ask for is not done.
struct MeshNeeds {
    bool depth_first = false;  ///< depth before the G-buffer; pays only where much is overdrawn
    bool shadows = false;      ///< a light that casts shadows
    bool shadows_each_frame = false;   ///< something that casts them moves
    bool glass = false;                ///< something lets light through
    bool reflections = false;          ///< something mirrors sharply
    std::vector<std::string> skipped;  ///< passes and parts that are left out, for people

    friend bool operator==(const MeshNeeds&, const MeshNeeds&) = default;
};

/// `all`: as if the scene asked for everything, to measure what leaving out saves.
[[nodiscard]] MeshNeeds needs_of(const mesh::MeshData& data, bool all);

}  // namespace gazeloop::scene
