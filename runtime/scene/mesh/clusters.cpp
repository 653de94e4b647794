#include "runtime/scene/mesh/clusters.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <map>
#include <utility>

namespace gazeloop::scene::mesh {
namespace {

/// Cones wider than this cosine cut nothing off worth a test.
constexpr float kLeastCosine = 0.1F;

}  // namespace

Clusters::Clusters(const MeshData& data) : indices_(data.indices) {
    std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> known;
    ranges_.reserve(data.primitives.size());
    for (const Primitive& primitive : data.primitives) {
        const std::pair place(primitive.first_index, primitive.first_vertex);
        auto at = known.find(place);
        if (at == known.end()) {
            at = known.emplace(place, static_cast<std::uint32_t>(clusters_.size())).first;
            const auto all =
                std::span(indices_).subspan(primitive.first_index, primitive.index_count);
            for (std::size_t i = 0; i < all.size(); i += std::size_t{3} * kTriangles) {
                clusters_.push_back(around(
                    data, primitive,
                    all.subspan(
                        i, std::min<std::size_t>(std::size_t{3} * kTriangles, all.size() - i))));
            }
        }
        ranges_.push_back({primitive.first_index, primitive.index_count, at->second});
    }
}

Clusters::Cluster Clusters::around(const MeshData& data, const Primitive& primitive,
                                   std::span<const std::uint32_t> indices) {
    const auto point = [&](std::uint32_t index) {
        return data.vertices[primitive.first_vertex + index].position_m;
    };
    Bounds bounds;
    for (const std::uint32_t index : indices) {
        bounds.low_m = glm::min(bounds.low_m, point(index));
        bounds.high_m = glm::max(bounds.high_m, point(index));
    }
    Cluster cluster{.centre_m = 0.5F * (bounds.low_m + bounds.high_m),
                    .radius_m = 0.5F * glm::length(bounds.high_m - bounds.low_m),
                    .axis = {},
                    .sine = 2.0F};
    const auto normal_of = [&](std::size_t i) {
        const glm::vec3 a = point(indices[i]);
        const glm::vec3 across = glm::cross(point(indices[i + 1]) - a, point(indices[i + 2]) - a);
        const float size = glm::length(across);
        return size > 0.0F ? across / size : glm::vec3(0.0F);
    };
    glm::vec3 sum(0.0F);
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        sum += normal_of(i);
    }
    const float length = glm::length(sum);
    if (!(length > 0.0F)) {
        return cluster;
    }
    cluster.axis = sum / length;
    float least = 1.0F;
    for (std::size_t i = 0; i < indices.size(); i += 3) {
        const glm::vec3 normal = normal_of(i);
        least = normal == glm::vec3(0.0F) ? least : std::min(least, glm::dot(cluster.axis, normal));
    }
    if (least > kLeastCosine) {
        // A little more than the cone, for rounding.
        cluster.sine = std::sqrt(1.0F - least * least) + 1e-3F;
    }
    return cluster;
}

Clusters::View Clusters::view_of(const Frustum& frustum, const glm::mat4x3& world_from_local) {
    const glm::mat3 axes(world_from_local);
    View view;
    view.eye_m = glm::inverse(axes) * (frustum.eye_m - world_from_local[3]);
    for (std::size_t i = 0; i < view.planes.size(); ++i) {
        const glm::vec3 inwards(frustum.planes.at(i));
        view.planes.at(i) =
            glm::vec4(glm::transpose(axes) * inwards,
                      glm::dot(inwards, world_from_local[3]) + frustum.planes.at(i).w);
    }
    return view;
}

bool Clusters::is_shown(const Cluster& cluster, const View& view) {
    // A little more than the sphere, for rounding.
    const float reach_m = cluster.radius_m * 1.001F;
    const glm::vec3 way = cluster.centre_m - view.eye_m;
    // Every triangle turns its back: the eye lies behind each one's plane.
    if (glm::dot(way, cluster.axis) > cluster.sine * glm::length(way) + reach_m) {
        return false;
    }
    return std::ranges::none_of(view.planes, [&](const glm::vec4& plane) {
        const glm::vec3 inwards(plane);
        return glm::dot(inwards, cluster.centre_m) + plane.w < -reach_m * glm::length(inwards);
    });
}

std::optional<std::uint32_t> Clusters::facing(std::uint32_t primitive, const View& view,
                                              std::span<std::uint32_t> out) const {
    const Range& range = ranges_[primitive];
    std::uint32_t written = 0;
    std::uint32_t number = range.first_cluster;
    for (std::uint32_t i = 0; i < range.index_count; i += 3 * kTriangles, ++number) {
        if (!is_shown(clusters_[number], view)) {
            continue;
        }
        const std::uint32_t count = std::min(3 * kTriangles, range.index_count - i);
        if (count > out.size() - written) {
            return std::nullopt;
        }
        std::memcpy(out.data() + written, indices_.data() + range.first_index + i,
                    count * sizeof(std::uint32_t));
        written += count;
    }
    return written;
}

}  // namespace gazeloop::scene::mesh
