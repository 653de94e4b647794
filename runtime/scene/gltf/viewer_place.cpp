#include "runtime/scene/gltf/viewer_place.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace gazeloop::scene::gltf {
namespace {

constexpr glm::dvec3 kUp{0.0, 1.0, 0.0};

glm::dmat4 four_rows(const glm::mat4x3& placement) {
    return {glm::dvec4(glm::dvec3(placement[0]), 0.0), glm::dvec4(glm::dvec3(placement[1]), 0.0),
            glm::dvec4(glm::dvec3(placement[2]), 0.0), glm::dvec4(glm::dvec3(placement[3]), 1.0)};
}

/// Upright at a place, looking along the horizontal part of `ahead`, or along -Z where it has none.
glm::dmat4 world_from_viewer(const glm::dvec3& place, const glm::dvec3& ahead) {
    const glm::dvec3 level(ahead.x, 0.0, ahead.z);
    const double length = glm::length(level);
    const glm::dvec3 back =
        length > 1e-6 * glm::length(ahead) ? -level / length : glm::dvec3(0.0, 0.0, 1.0);
    const glm::dvec3 right = glm::cross(kUp, back);
    return {glm::dvec4(right, 0.0), glm::dvec4(kUp, 0.0), glm::dvec4(back, 0.0),
            glm::dvec4(place, 1.0)};
}

mesh::Bounds bounds_of(const mesh::MeshData& data) {
    mesh::Bounds bounds;
    for (const mesh::Instance& instance : data.instances) {
        const mesh::Bounds& own =
            data.primitives.at(data.levels.at(instance.first_level).primitive).bounds;
        for (unsigned corner = 0; corner < 8; ++corner) {
            const glm::vec3 at((corner & 1U) != 0 ? own.high_m.x : own.low_m.x,
                               (corner & 2U) != 0 ? own.high_m.y : own.low_m.y,
                               (corner & 4U) != 0 ? own.high_m.z : own.low_m.z);
            const glm::vec3 world = instance.world_from_local * glm::vec4(at, 1.0F);
            bounds.low_m = glm::min(bounds.low_m, world);
            bounds.high_m = glm::max(bounds.high_m, world);
        }
    }
    return bounds;
}

glm::dmat4 world_from_viewer(const mesh::MeshData& data) {
    if (!data.viewpoints.empty()) {
        const glm::dmat4 camera = four_rows(data.viewpoints.front().world_from_camera);
        return world_from_viewer(glm::dvec3(camera[3]), -glm::dvec3(camera[2]));
    }
    const mesh::Bounds bounds = bounds_of(data);
    const glm::dvec3 low(bounds.low_m);
    const glm::dvec3 high(bounds.high_m);
    const glm::dvec3 half = 0.5 * (high - low);
    // 90 degrees: the nearest face's half width is its distance.
    const glm::dvec3 place(low.x + half.x, low.y + half.y, high.z + std::max(half.x, half.y));
    return world_from_viewer(place, glm::dvec3(0.0, 0.0, -1.0));
}

}  // namespace

void place_before_viewer(mesh::MeshData& data) {
    const glm::dmat4 viewer_from_world = glm::inverse(world_from_viewer(data));
    const auto moved = [&](const glm::mat4x3& placement) {
        return glm::mat4x3(viewer_from_world * four_rows(placement));
    };
    for (mesh::Instance& instance : data.instances) {
        instance.world_from_local = moved(instance.world_from_local);
    }
    for (mesh::Viewpoint& viewpoint : data.viewpoints) {
        viewpoint.world_from_camera = moved(viewpoint.world_from_camera);
    }
    for (mesh::Light& light : data.lights) {
        light.position_m =
            glm::vec3(viewer_from_world * glm::dvec4(glm::dvec3(light.position_m), 1.0));
        light.direction =
            glm::vec3(glm::normalize(glm::dmat3(viewer_from_world) * glm::dvec3(light.direction)));
    }
}

}  // namespace gazeloop::scene::gltf
