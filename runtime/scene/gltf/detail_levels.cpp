#include "runtime/scene/gltf/detail_levels.h"

#include <meshoptimizer.h>

#include <cstdint>
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

/// A form and the vertices that it uses alone, since each step costs by the vertices it is given.
struct Form {
    std::vector<glm::vec3> positions_m;
    std::vector<std::uint32_t> vertices;  ///< of the shape, rising: what each position is of
    std::vector<std::uint32_t> indices;   ///< into both
};

Form whole_shape(const Geometry& geometry) {
    Form form;
    form.indices = geometry.indices;
    form.positions_m.reserve(geometry.vertices.size());
    for (const mesh::Vertex& vertex : geometry.vertices) {
        form.positions_m.push_back(vertex.position_m);
    }
    form.vertices.resize(geometry.vertices.size());
    std::iota(form.vertices.begin(), form.vertices.end(), 0U);
    return form;
}

/// What `indices` use of a form. They keep their order, so that steps from it stay the same.
Form part_of(const Form& form, std::vector<std::uint32_t> indices) {
    std::vector<std::uint32_t> place(form.vertices.size(), 0);
    for (const std::uint32_t index : indices) {
        place[index] = 1;
    }
    Form part;
    for (std::size_t i = 0; i < place.size(); ++i) {
        if (place[i] != 0) {
            place[i] = static_cast<std::uint32_t>(part.vertices.size());
            part.vertices.push_back(form.vertices[i]);
            part.positions_m.push_back(form.positions_m[i]);
        }
    }
    for (std::uint32_t& index : indices) {
        index = place[index];
    }
    part.indices = std::move(indices);
    return part;
}

float extent_m(const Form& form) {
    return meshopt_simplifyScale(&form.positions_m.front().x, form.positions_m.size(),
                                 sizeof(glm::vec3));
}

/// Of a form, at most `wanted` indices if `most_error_m` allows; adds to `error_m`.
std::vector<std::uint32_t> simplified(const Form& form, std::size_t wanted, float most_error_m,
                                      float& error_m) {
    const float extent = extent_m(form);
    std::vector<std::uint32_t> indices(form.indices.size());
    float step = 0.0F;  // of the extent, as the limit
    indices.resize(meshopt_simplify(indices.data(), form.indices.data(), form.indices.size(),
                                    &form.positions_m.front().x, form.positions_m.size(),
                                    sizeof(glm::vec3), wanted, most_error_m / extent, 0, &step));
    error_m += step * extent;
    return indices;
}

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
    Form finer = whole_shape(geometry);
    const float most_error_m = kMostError * extent_m(finer);
    if (!(most_error_m > 0.0F)) {
        return;  // a point
    }
    float error_m = 0.0F;
    geometry.coarser.reserve(kMostForms);
    while (geometry.coarser.size() < kMostForms &&
           finer.indices.size() / 12 >= kCoarsestTriangles) {
        const std::size_t wanted = finer.indices.size() / 12 * 3;
        // Each form is made of the one before, so that errors add up.
        std::vector<std::uint32_t> indices = simplified(finer, wanted, most_error_m, error_m);
        // One that saves less than half is not worth its memory.
        if (indices.empty() || error_m > most_error_m || indices.size() > 2 * wanted) {
            return;
        }
        finer = part_of(finer, std::move(indices));
        meshopt_optimizeVertexCacheFifo(finer.indices.data(), finer.indices.data(),
                                        finer.indices.size(), finer.vertices.size(), kCacheSize);
        CoarserForm& form = geometry.coarser.emplace_back();
        form.error_m = error_m;
        form.indices.reserve(finer.indices.size());
        for (const std::uint32_t index : finer.indices) {
            form.indices.push_back(finer.vertices[index]);
        }
    }
}

}  // namespace gazeloop::scene::gltf
