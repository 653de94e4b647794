#include "runtime/scene/gltf/accessor.h"

namespace gazeloop::scene::gltf {
namespace {

template <typename Stored>
void append(const std::byte* from, std::size_t stride, std::uint64_t count,
            std::vector<std::uint32_t>& to) {
    for (std::uint64_t i = 0; i < count; ++i, from += stride) {
        Stored stored{};
        std::memcpy(&stored, from, sizeof stored);
        to.push_back(stored);
    }
}

/// Unsigned integers that lie `stride` apart.
std::vector<std::uint32_t> integers(const std::byte* from, std::size_t stride, std::uint64_t count,
                                    Component component) {
    std::vector<std::uint32_t> to;
    to.reserve(count);
    switch (component) {
        case Component::Uint8:
            append<std::uint8_t>(from, stride, count, to);
            break;
        case Component::Uint16:
            append<std::uint16_t>(from, stride, count, to);
            break;
        default:
            append<std::uint32_t>(from, stride, count, to);
            break;
    }
    return to;
}

}  // namespace

std::vector<std::uint32_t> read_sparse_indices(const Source& source, std::uint32_t index) {
    const Accessor& accessor = source.document.accessors.at(index);
    const Sparse& sparse = *accessor.sparse;
    const auto bytes = bytes_of(source.document, source.buffers, sparse.index_view);
    auto where =
        integers(bytes.data() + sparse.index_offset, component_bytes(sparse.index_component),
                 sparse.count, sparse.index_component);
    for (std::size_t i = 0; i < where.size(); ++i) {
        if (where[i] >= accessor.count || (i > 0 && where[i] <= where[i - 1])) {
            refuse(fmt::format("/accessors/{}/sparse/indices", index),
                   fmt::format("index {} is {}; they must increase and be below {}", i, where[i],
                               accessor.count));
        }
    }
    return where;
}

std::vector<std::uint32_t> read_indices(const Source& source, std::uint32_t index) {
    const Accessor& accessor = source.document.accessors.at(index);
    std::vector<std::uint32_t> indices;
    if (accessor.view) {
        const std::size_t stride = source.document.views.at(*accessor.view).stride;
        const auto bytes = bytes_of(source.document, source.buffers, *accessor.view);
        indices = integers(bytes.data() + accessor.offset,
                           stride == 0 ? component_bytes(accessor.component) : stride,
                           accessor.count, accessor.component);
    } else {
        indices.assign(accessor.count, 0);
    }
    if (accessor.sparse) {
        const auto where = read_sparse_indices(source, index);
        const auto bytes = bytes_of(source.document, source.buffers, accessor.sparse->value_view);
        const auto values =
            integers(bytes.data() + accessor.sparse->value_offset,
                     component_bytes(accessor.component), where.size(), accessor.component);
        for (std::size_t i = 0; i < where.size(); ++i) {
            indices[where[i]] = values[i];
        }
    }
    return indices;
}

}  // namespace gazeloop::scene::gltf
