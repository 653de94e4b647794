#include "runtime/scene/gltf/detail_levels.h"

#include <meshoptimizer.h>

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
    const float scale =
        meshopt_simplifyScale(positions_of(geometry), geometry.vertices.size(), kStride);
    const std::vector<std::uint32_t>* finer = &geometry.indices;
    float error = 0.0F;
    geometry.coarser.reserve(kMostForms);
    while (geometry.coarser.size() < kMostForms && finer->size() / 12 >= kCoarsestTriangles) {
        const std::size_t wanted = finer->size() / 12 * 3;
        CoarserForm form{.indices = std::vector<std::uint32_t>(finer->size()), .error_m = 0.0F};
        float step = 0.0F;
        form.indices.resize(meshopt_simplify(form.indices.data(), finer->data(), finer->size(),
                                             positions_of(geometry), geometry.vertices.size(),
                                             kStride, wanted, kMostError, 0, &step));
        error += step;  // each form is made of the one before
        // One that saves less than half is not worth its memory.
        if (form.indices.empty() || error > kMostError || form.indices.size() > 2 * wanted) {
            return;
        }
        form.error_m = error * scale;
        meshopt_optimizeVertexCacheFifo(form.indices.data(), form.indices.data(),
                                        form.indices.size(), geometry.vertices.size(), kCacheSize);
        form.indices.shrink_to_fit();
        geometry.coarser.push_back(std::move(form));
        finer = &geometry.coarser.back().indices;
    }
}

}  // namespace gazeloop::scene::gltf
