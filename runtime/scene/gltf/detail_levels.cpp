#include "runtime/scene/gltf/detail_levels.h"

#include <meshoptimizer.h>

#include <algorithm>
#include <numeric>
#include <utility>
#include <vector>

namespace gazeloop::scene::gltf {
namespace {

constexpr std::size_t kStride = sizeof(mesh::Vertex);
/// Of vertices, as GPUs and lavapipe keep them. A quarter of the time of the order for a cache of
/// unknown size, which is 3 % better; an order against overdraw is not needed where depth is drawn
/// before.
constexpr unsigned kCacheSize = 16;
constexpr std::size_t kFewestTriangles = 1024;
constexpr std::size_t kCoarsestTriangles = 256;
constexpr std::size_t kMostForms = 3;
/// Of the shape's extent.
constexpr float kMostError = 0.02F;

const float* positions_of(const Geometry& geometry) {
    return &geometry.vertices.front().position_m.x;
}

/// The vertices that a form uses, and no others: simplification takes time for each that it is
/// given, and those of the finest form are soon most.
class UsedVertices {
  public:
    std::vector<std::uint32_t> triangles;
    std::vector<glm::vec3> positions_m;

    /// Of the finest form, which uses all.
    explicit UsedVertices(const Geometry& geometry)
        : triangles(geometry.indices), vertices_(geometry.vertices.size()) {
        positions_m.reserve(geometry.vertices.size());
        for (const mesh::Vertex& vertex : geometry.vertices) {
            positions_m.push_back(vertex.position_m);
        }
        std::iota(vertices_.begin(), vertices_.end(), 0U);
    }

    /// Triangles of these vertices as triangles of the shape's.
    [[nodiscard]] std::vector<std::uint32_t> in_shape(
        const std::vector<std::uint32_t>& form) const {
        std::vector<std::uint32_t> of_shape(form.size());
        std::ranges::transform(form, of_shape.begin(),
                               [&](std::uint32_t index) { return vertices_[index]; });
        return of_shape;
    }

    /// Goes on with a form of these vertices, in the order of their first use.
    void keep(std::vector<std::uint32_t> form) {
        std::vector<std::uint32_t> place(vertices_.size());
        const std::size_t count = meshopt_optimizeVertexFetchRemap(place.data(), form.data(),
                                                                   form.size(), vertices_.size());
        std::vector<std::uint32_t> kept(count);
        std::vector<glm::vec3> kept_m(count);
        for (std::size_t i = 0; i < place.size(); ++i) {
            if (place[i] != mesh::kNone) {
                kept[place[i]] = vertices_[i];
                kept_m[place[i]] = positions_m[i];
            }
        }
        for (std::uint32_t& index : form) {
            index = place[index];
        }
        triangles = std::move(form);
        vertices_ = std::move(kept);
        positions_m = std::move(kept_m);
    }

  private:
    std::vector<std::uint32_t> vertices_;  ///< of the shape, by place here
};

}  // namespace

void order_for_gpu(Geometry& geometry) {
    if (geometry.indices.empty()) {
        geometry.vertices.clear();
        return;
    }
    std::vector<std::uint32_t>& indices = geometry.indices;
    const std::size_t vertex_count = geometry.vertices.size();
    meshopt_optimizeVertexCacheFifo(indices.data(), indices.data(), indices.size(), vertex_count,
                                    kCacheSize);
    std::vector<mesh::Vertex> ordered(vertex_count);
    ordered.resize(meshopt_optimizeVertexFetch(ordered.data(), indices.data(), indices.size(),
                                               geometry.vertices.data(), vertex_count, kStride));
    geometry.vertices = std::move(ordered);
}

void add_coarser_forms(Geometry& geometry) {
    if (geometry.indices.size() / 3 < kFewestTriangles) {
        return;
    }
    const float extent_m =
        meshopt_simplifyScale(positions_of(geometry), geometry.vertices.size(), kStride);
    UsedVertices used(geometry);
    float error_m = 0.0F;
    geometry.coarser.reserve(kMostForms);
    while (geometry.coarser.size() < kMostForms &&
           used.triangles.size() / 12 >= kCoarsestTriangles) {
        const std::size_t wanted = used.triangles.size() / 12 * 3;
        const float used_extent_m = meshopt_simplifyScale(
            &used.positions_m.front().x, used.positions_m.size(), sizeof(glm::vec3));
        std::vector<std::uint32_t> form(used.triangles.size());
        float step = 0.0F;
        form.resize(meshopt_simplify(form.data(), used.triangles.data(), form.size(),
                                     &used.positions_m.front().x, used.positions_m.size(),
                                     sizeof(glm::vec3), wanted, kMostError, 0, &step));
        error_m += step * used_extent_m;  // each form is made of the one before
        // One that saves less than half is not worth its memory.
        if (form.empty() || error_m > kMostError * extent_m || form.size() > 2 * wanted) {
            return;
        }
        meshopt_optimizeVertexCacheFifo(form.data(), form.data(), form.size(),
                                        used.positions_m.size(), kCacheSize);
        geometry.coarser.push_back({used.in_shape(form), error_m});
        used.keep(std::move(form));
    }
}

}  // namespace gazeloop::scene::gltf
