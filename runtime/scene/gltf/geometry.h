#pragma once

#include <array>
#include <optional>
#include <vector>

#include "runtime/scene/gltf/accessor.h"
#include "runtime/scene/gltf/load_limits.h"
#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::gltf {

/// What a primitive's shape depends on; equal ones are made once.
struct GeometryKey {
    std::map<std::string, std::uint32_t> attributes;
    std::optional<std::uint32_t> indices;
    Mode mode = Mode::Triangles;
    /// n of the TEXCOORD_n that go to the vertex' two places; mesh::kNone: none.
    std::array<std::uint32_t, 2> uv_sets{mesh::kNone, mesh::kNone};
    std::uint32_t tangent_slot = mesh::kNone;  ///< of uv_sets, along which a normal map is laid

    auto operator<=>(const GeometryKey&) const = default;
};

/// A coarser form of a shape, of the same vertices.
struct CoarserForm {
    std::vector<std::uint32_t> indices;
    float error_m = 0.0F;  ///< as mesh::DetailLevel
};

/// A primitive's shape: triangles over vertices that are all used.
struct Geometry {
    std::vector<mesh::Vertex> vertices;
    std::vector<std::uint32_t> indices;
    std::vector<CoarserForm> coarser;  ///< finest first
};

/// Reads a primitive. Empty where it has nothing to show: points, lines, no positions. What the
/// standard leaves to the reader is made: flat normals where there are none, tangents where a
/// normal map needs them. Throws Refusal, `place` being the primitive's. Adds to `notes` what was
/// changed.
[[nodiscard]] Geometry read_geometry(const Source& source, const GeometryKey& key,
                                     const std::string& place, Budget& budget, Notes& notes);

}  // namespace gazeloop::scene::gltf
