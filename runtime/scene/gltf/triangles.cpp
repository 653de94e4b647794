#include "runtime/scene/gltf/triangles.h"

namespace gazeloop::scene::gltf {
namespace {

void add(std::vector<std::uint32_t>& triangles, std::uint32_t a, std::uint32_t b, std::uint32_t c) {
    if (a != b && b != c && c != a) {
        triangles.insert(triangles.end(), {a, b, c});
    }
}

}  // namespace

std::optional<std::vector<std::uint32_t>> triangles_of(Mode mode,
                                                       std::vector<std::uint32_t> indices) {
    const std::size_t count = indices.size();
    std::vector<std::uint32_t> triangles;
    switch (mode) {
        case Mode::Triangles:
            indices.resize(count - count % 3);
            return indices;
        case Mode::TriangleStrip:
            for (std::size_t i = 0; i + 2 < count; ++i) {
                add(triangles, indices[i], indices[i + 1 + i % 2], indices[i + 2 - i % 2]);
            }
            return triangles;
        case Mode::TriangleFan:
            for (std::size_t i = 0; i + 2 < count; ++i) {
                add(triangles, indices[i + 1], indices[i + 2], indices[0]);
            }
            return triangles;
        default:
            return std::nullopt;
    }
}

}  // namespace gazeloop::scene::gltf
