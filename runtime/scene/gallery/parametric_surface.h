#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::gallery {

/// A closed surface over (u, v) in [0, 1]^2, about as large as a ball of radius 1. Seen from
/// outside, v runs down where u runs to the right.
struct ParametricSurface {
    std::string_view name;
    glm::dvec3 (*at)(double u, double v);
    /// Rows over columns of a tessellation with cells that are about square.
    double aspect = 1.0;
    /// How often a texture repeats along u and v.
    glm::dvec2 repeats{2.0, 2.0};
};

/// The eight shapes of the gallery.
[[nodiscard]] std::span<const ParametricSurface> parametric_surfaces();

/// A tessellation of a surface, indices relative to its own vertices.
struct Tessellation {
    std::vector<mesh::Vertex> vertices;
    std::vector<std::uint32_t> indices;
    mesh::Bounds bounds;
    /// How far its edges lie from the surface: twice the root mean square at their middles, since
    /// the greatest distance is that of a few sharp places in every tessellation.
    float error_m = 0.0F;
};

/// At most `triangles` triangles, at least 16; those without area, at poles, are left out.
[[nodiscard]] Tessellation tessellate(const ParametricSurface& surface, std::uint32_t triangles);

}  // namespace gazeloop::scene::gallery
