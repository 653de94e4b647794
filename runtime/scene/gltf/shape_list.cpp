#include "runtime/scene/gltf/shape_list.h"

#include <fmt/format.h>

#include <glm/common.hpp>

#include "runtime/scene/gltf/refusal.h"

namespace gazeloop::scene::gltf {

void ShapeList::put(std::size_t number, Geometry geometry) {
    const std::scoped_lock lock(mutex_);
    shapes_.at(number).waiting = std::move(geometry);
    shapes_.at(number).is_put = true;
    for (; next_ < shapes_.size() && shapes_[next_].is_put; ++next_) {
        append(shapes_[next_]);
        shapes_[next_].waiting = {};
    }
}

ShapeList::Form ShapeList::appended(const std::vector<std::uint32_t>& indices, float error_m) {
    const auto first = static_cast<std::uint32_t>(data_.indices.size());
    data_.indices.insert(data_.indices.end(), indices.begin(), indices.end());
    return {first, static_cast<std::uint32_t>(indices.size()), error_m};
}

void ShapeList::append(Shape& shape) {
    const Geometry& geometry = shape.waiting;
    std::uint64_t index_count = data_.indices.size() + geometry.indices.size();
    for (const CoarserForm& form : geometry.coarser) {
        index_count += form.indices.size();
    }
    // The GPU adds the first vertex as a signed number of 32 bits.
    constexpr std::uint64_t kMostVertices = 0x7FFFFFFF;
    constexpr std::uint64_t kMostIndices = 0xFFFFFFFF;
    if (data_.vertices.size() + geometry.vertices.size() > kMostVertices ||
        index_count > kMostIndices) {
        refuse("", fmt::format("has more than {} vertices or {} indices, which a GPU cannot "
                               "address at once; make it smaller",
                               kMostVertices, kMostIndices));
    }
    shape.first_vertex = static_cast<std::uint32_t>(data_.vertices.size());
    shape.vertex_count = static_cast<std::uint32_t>(geometry.vertices.size());
    for (const mesh::Vertex& vertex : geometry.vertices) {
        shape.bounds.low_m = glm::min(shape.bounds.low_m, vertex.position_m);
        shape.bounds.high_m = glm::max(shape.bounds.high_m, vertex.position_m);
    }
    data_.vertices.insert(data_.vertices.end(), geometry.vertices.begin(), geometry.vertices.end());
    if (!geometry.indices.empty()) {
        shape.forms.push_back(appended(geometry.indices, 0.0F));
        for (const CoarserForm& form : geometry.coarser) {
            shape.forms.push_back(appended(form.indices, form.error_m));
        }
    }
}

std::pair<std::uint32_t, std::uint32_t> ShapeList::add_levels(std::uint32_t number,
                                                              std::uint32_t material) {
    const Shape& shape = shapes_.at(number);
    const auto first = static_cast<std::uint32_t>(data_.levels.size());
    for (const Form& form : shape.forms) {
        data_.levels.push_back({.primitive = static_cast<std::uint32_t>(data_.primitives.size()),
                                .error_m = form.error_m});
        data_.primitives.push_back({.first_index = form.first_index,
                                    .index_count = form.index_count,
                                    .first_vertex = shape.first_vertex,
                                    .vertex_count = shape.vertex_count,
                                    .material = material,
                                    .bounds = shape.bounds});
    }
    return {first, static_cast<std::uint32_t>(shape.forms.size())};
}

}  // namespace gazeloop::scene::gltf
