#pragma once

#include <glm/geometric.hpp>

#include "runtime/scene/mesh/mesh_data.h"

namespace gazeloop::scene::mesh {

/// A square with corners at +-half_m around the origin, facing +Z, in one material; in world where
/// `world_from_local` puts it.
inline MeshData square(float half_m, const glm::mat4x3& world_from_local,
                       const Material& material = {}) {
    MeshData data;
    const auto corner = [&](float x, float y) {
        Vertex vertex;
        vertex.position_m = {x * half_m, y * half_m, 0.0F};
        vertex.uv[0] = {0.5F + 0.5F * x, 0.5F - 0.5F * y};
        data.vertices.push_back(vertex);
    };
    corner(-1.0F, -1.0F);
    corner(1.0F, -1.0F);
    corner(1.0F, 1.0F);
    corner(-1.0F, 1.0F);
    data.indices = {0, 1, 2, 0, 2, 3};
    data.primitives = {{.index_count = 6,
                        .vertex_count = 4,
                        .bounds = {{-half_m, -half_m, 0.0F}, {half_m, half_m, 0.0F}}}};
    data.levels = {{0, 0.0F}};
    data.instances = {{.world_from_local = world_from_local}};
    data.materials = {material};
    return data;
}

/// A frame without rotation whose origin lies there.
inline glm::mat4x3 moved(const glm::vec3& to_m) {
    glm::mat4x3 frame(1.0F);
    frame[3] = to_m;
    return frame;
}

}  // namespace gazeloop::scene::mesh
