#include "runtime/scene/gltf/vertex_frames.h"

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <vector>

namespace gazeloop::scene::gltf {
namespace {

constexpr glm::vec3 kUp{0.0F, 0.0F, 1.0F};

/// In double, since squares of small or large coordinates leave single precision.
glm::vec3 direction_or(const glm::dvec3& vector, const glm::vec3& otherwise) {
    const double length = glm::length(vector);
    return length > 0.0 && std::isfinite(length) ? glm::vec3(vector / length) : otherwise;
}

/// Its length is twice the triangle's area.
glm::dvec3 normal_of(std::span<const mesh::Vertex> vertices, const std::uint32_t* triangle) {
    const glm::dvec3 a(vertices[triangle[0]].position_m);
    return glm::cross(glm::dvec3(vertices[triangle[1]].position_m) - a,
                      glm::dvec3(vertices[triangle[2]].position_m) - a);
}

/// Between two edges; 0 where one has no length.
double angle_rad(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

/// The unit direction in which u grows, and 1 or -1; of a triangle whose coordinates span nothing,
/// 0.
struct Frame {
    glm::dvec3 along_u{0.0};
    double handedness = 0.0;
};

Frame frame_of(const mesh::Vertex& a, const mesh::Vertex& b, const mesh::Vertex& c,
               std::size_t uv_slot) {
    const glm::dvec3 ab = glm::dvec3(b.position_m) - glm::dvec3(a.position_m);
    const glm::dvec3 ac = glm::dvec3(c.position_m) - glm::dvec3(a.position_m);
    const glm::dvec2 uv_ab = glm::dvec2(b.uv[uv_slot]) - glm::dvec2(a.uv[uv_slot]);
    const glm::dvec2 uv_ac = glm::dvec2(c.uv[uv_slot]) - glm::dvec2(a.uv[uv_slot]);
    const double area = uv_ab.x * uv_ac.y - uv_ab.y * uv_ac.x;
    if (area == 0.0 || !std::isfinite(area)) {
        return {};
    }
    const double sign = area > 0.0 ? 1.0 : -1.0;
    const glm::dvec3 along_u = sign * (uv_ac.y * ab - uv_ab.y * ac);
    const double length = glm::length(along_u);
    if (!(length > 0.0) || !std::isfinite(length)) {
        return {};
    }
    // v points down in the picture and up in the tangent frame: glTF's bitangent is against v.
    return {along_u / length, -sign};
}

}  // namespace

glm::vec3 perpendicular_to(glm::vec3 unit) {
    const glm::vec3 other =
        std::abs(unit.x) < 0.7F ? glm::vec3(1.0F, 0.0F, 0.0F) : glm::vec3(0.0F, 1.0F, 0.0F);
    return glm::normalize(other - unit * glm::dot(unit, other));
}

void make_flat_normals(std::span<mesh::Vertex> vertices, std::span<const std::uint32_t> triangles) {
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const glm::vec3 normal = direction_or(normal_of(vertices, &triangles[i]), kUp);
        for (std::size_t corner = 0; corner < 3; ++corner) {
            vertices[triangles[i + corner]].normal = normal;
        }
    }
}

std::size_t make_unit_normals(std::span<mesh::Vertex> vertices,
                              std::span<const std::uint32_t> triangles) {
    std::vector<std::uint32_t> without;
    for (std::uint32_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec3 normal(vertices[i].normal);
        const double length = glm::length(normal);
        if (length > 0.0) {
            vertices[i].normal = glm::vec3(normal / length);
        } else {
            without.push_back(i);
        }
    }
    if (without.empty()) {
        return 0;
    }
    std::vector<glm::dvec3> sums(vertices.size(), glm::dvec3(0.0));
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        for (std::size_t corner = 0; corner < 3; ++corner) {
            sums[triangles[i + corner]] += normal_of(vertices, &triangles[i]);
        }
    }
    for (const std::uint32_t vertex : without) {
        vertices[vertex].normal = direction_or(sums[vertex], kUp);
    }
    return without.size();
}

void make_tangents(std::span<mesh::Vertex> vertices, std::span<const std::uint32_t> triangles,
                   std::size_t uv_slot) {
    std::vector<Frame> frames(vertices.size());
    for (std::size_t i = 0; i + 2 < triangles.size(); i += 3) {
        const std::array corners{triangles[i], triangles[i + 1], triangles[i + 2]};
        const Frame frame =
            frame_of(vertices[corners[0]], vertices[corners[1]], vertices[corners[2]], uv_slot);
        if (frame.handedness == 0.0) {
            continue;
        }
        const glm::dvec3 a(vertices[corners[0]].position_m);
        const glm::dvec3 b(vertices[corners[1]].position_m);
        const glm::dvec3 c(vertices[corners[2]].position_m);
        std::array<double, 3> angles{angle_rad(b - a, c - a), angle_rad(c - b, a - b), 0.0};
        angles[2] = std::numbers::pi - angles[0] - angles[1];
        for (std::size_t corner = 0; corner < 3; ++corner) {
            frames[corners[corner]].along_u += angles[corner] * frame.along_u;
            frames[corners[corner]].handedness += angles[corner] * frame.handedness;
        }
    }
    for (std::size_t i = 0; i < vertices.size(); ++i) {
        const glm::dvec3 normal(vertices[i].normal);
        const glm::dvec3 along = frames[i].along_u - normal * glm::dot(normal, frames[i].along_u);
        vertices[i].tangent = glm::vec4(
            glm::length(along) > 1e-9 ? direction_or(along, perpendicular_to(vertices[i].normal))
                                      : perpendicular_to(vertices[i].normal),
            frames[i].handedness < 0.0 ? -1.0F : 1.0F);
    }
}

}  // namespace gazeloop::scene::gltf
