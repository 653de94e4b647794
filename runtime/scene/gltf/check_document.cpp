#include "runtime/scene/gltf/check_document.h"

#include <fmt/format.h>

#include <algorithm>

namespace gazeloop::scene::gltf {
namespace {

// Offsets, lengths and counts are below 2^53 and strides below 2^8 (apply_rules), so that neither
// their sums nor the products of counts and strides overflow 64 bits.

void check_views(const Document& document) {
    for (std::size_t i = 0; i < document.views.size(); ++i) {
        const BufferView& view = document.views[i];
        const std::uint64_t there = document.buffers.at(view.buffer).bytes;
        if (view.offset + view.bytes > there) {
            refuse(fmt::format("/bufferViews/{}", i),
                   fmt::format("bytes {} to {} are past the end of buffer {}, which has {}",
                               view.offset, view.offset + view.bytes, view.buffer, there));
        }
    }
}

/// `bytes_each` at every `stride` from `offset` on must lie inside the view.
void check_range(const BufferView& view, std::uint64_t offset, std::uint64_t count,
                 std::uint64_t stride, std::uint64_t bytes_each, const std::string& place) {
    const std::uint64_t end = offset + (count - 1) * stride + bytes_each;
    if (end > view.bytes) {
        refuse(place, fmt::format("its {} elements end at byte {} of a view that has {}", count,
                                  end, view.bytes));
    }
}

void note_alignment(const BufferView& view, std::uint64_t offset, Component component,
                    const std::string& place, Notes& notes) {
    const std::uint32_t alignment = component_bytes(component);
    if (offset % alignment != 0 || (view.offset + offset) % alignment != 0) {
        notes.add(
            "alignment", place,
            fmt::format("byte {} is no multiple of its component's {} bytes: read all the same",
                        view.offset + offset, alignment));
    }
}

void check_sparse(const Document& document, const Accessor& accessor, const std::string& place,
                  Notes& notes) {
    const Sparse& sparse = *accessor.sparse;
    if (sparse.count > accessor.count) {
        refuse(place + "/sparse/count",
               fmt::format("replaces {} of {} elements", sparse.count, accessor.count));
    }
    const BufferView& indices = document.views.at(sparse.index_view);
    const BufferView& values = document.views.at(sparse.value_view);
    for (const auto& [view, name] :
         {std::pair{&indices, "indices"}, std::pair{&values, "values"}}) {
        if (view->stride != 0) {
            refuse(fmt::format("{}/sparse/{}/bufferView", place, name),
                   "this view has a byteStride, which sparse elements must not have");
        }
    }
    const std::uint32_t index_bytes = component_bytes(sparse.index_component);
    check_range(indices, sparse.index_offset, sparse.count, index_bytes, index_bytes,
                place + "/sparse/indices");
    note_alignment(indices, sparse.index_offset, sparse.index_component, place + "/sparse/indices",
                   notes);
    const std::uint32_t value_bytes = element_bytes(accessor.type, accessor.component);
    check_range(values, sparse.value_offset, sparse.count, value_bytes, value_bytes,
                place + "/sparse/values");
    note_alignment(values, sparse.value_offset, accessor.component, place + "/sparse/values",
                   notes);
}

void check_accessor(const Document& document, const Accessor& accessor, const std::string& place,
                    Notes& notes) {
    const std::uint32_t bytes_each = element_bytes(accessor.type, accessor.component);
    if (accessor.view) {
        const BufferView& view = document.views.at(*accessor.view);
        if (view.stride != 0 && view.stride < bytes_each) {
            refuse(place, fmt::format("its elements have {} bytes, its view a byteStride of {}",
                                      bytes_each, view.stride));
        }
        if (view.stride % component_bytes(accessor.component) != 0) {
            notes.add("stride", place,
                      fmt::format("a byteStride of {} is no multiple of its component's {} bytes: "
                                  "read all the same",
                                  view.stride, component_bytes(accessor.component)));
        }
        check_range(view, accessor.offset, accessor.count,
                    view.stride == 0 ? bytes_each : view.stride, bytes_each, place);
        note_alignment(view, accessor.offset, accessor.component, place, notes);
    } else if (accessor.offset != 0) {
        notes.add("offset without view", place + "/byteOffset", "has no bufferView: left out");
    }
    if (accessor.normalized &&
        (accessor.component == Component::Float || accessor.component == Component::Uint32)) {
        notes.add("normalized", place + "/normalized",
                  "32-bit components cannot be normalized: taken as they are");
    }
    const std::uint32_t components = component_count(accessor.type);
    for (const auto& [bounds, name] :
         {std::pair{&accessor.min, "min"}, std::pair{&accessor.max, "max"}}) {
        if (!bounds->empty() && bounds->size() != components) {
            refuse(fmt::format("{}/{}", place, name),
                   fmt::format("has {} numbers, its elements have {}", bounds->size(), components));
        }
    }
    if (accessor.sparse) {
        check_sparse(document, accessor, place, notes);
    }
}

// ---- what primitives use ------------------------------------------------------------------------

std::string name_of(const Accessor& accessor) {
    constexpr std::array kComponents{"signed bytes",    "bytes",           "signed 16-bit integers",
                                     "16-bit integers", "32-bit integers", "floats"};
    constexpr std::array kTypes{"SCALAR", "VEC2", "VEC3", "VEC4", "MAT2", "MAT3", "MAT4"};
    return fmt::format("{} of {}{}", kTypes.at(static_cast<std::size_t>(accessor.type)),
                       accessor.normalized ? "normalized " : "",
                       kComponents.at(static_cast<std::size_t>(accessor.component)));
}

bool is_small(Component component) {
    return component != Component::Float && component != Component::Uint32;
}
bool is_signed_small(Component component) {
    return component == Component::Int8 || component == Component::Int16;
}

/// What an attribute may be: by the standard, or only by KHR_mesh_quantization.
struct Allowed {
    bool standard = false;
    bool quantized = false;
};

Allowed allowed(std::string_view semantic, const Accessor& accessor) {
    const bool is_float = accessor.component == Component::Float;
    const bool small_normalized = is_small(accessor.component) && accessor.normalized;
    const bool unsigned_normalized = small_normalized && !is_signed_small(accessor.component);
    if (semantic == "POSITION") {
        const bool type = accessor.type == ElementType::Vec3;
        return {type && is_float, type && is_small(accessor.component)};
    }
    if (semantic == "NORMAL" || semantic == "TANGENT") {
        const bool type =
            accessor.type == (semantic == "NORMAL" ? ElementType::Vec3 : ElementType::Vec4);
        return {type && is_float, type && small_normalized && is_signed_small(accessor.component)};
    }
    if (semantic.starts_with("TEXCOORD_")) {
        const bool type = accessor.type == ElementType::Vec2;
        return {type && (is_float || unsigned_normalized), type && is_small(accessor.component)};
    }
    const bool type = accessor.type == ElementType::Vec3 || accessor.type == ElementType::Vec4;
    return {type && (is_float || unsigned_normalized), false};  // COLOR_n
}

bool is_read(std::string_view semantic) {
    return semantic == "POSITION" || semantic == "NORMAL" || semantic == "TANGENT" ||
           semantic == "COLOR_0" || semantic.starts_with("TEXCOORD_");
}

void check_attribute(const Document& document, const std::string& semantic,
                     const Accessor& accessor, const std::string& place, Notes& notes) {
    if (!is_read(semantic)) {
        if (semantic.starts_with("COLOR_")) {
            notes.add("colors", place, fmt::format("{} is not shown: COLOR_0 alone is", semantic));
        }
        return;
    }
    const Allowed may = allowed(semantic, accessor);
    if (!may.standard && !may.quantized) {
        refuse(place, fmt::format("{} cannot be a {}", semantic, name_of(accessor)));
    }
    if (!may.standard && !document.is_quantized) {
        notes.add("undeclared KHR_mesh_quantization", place,
                  fmt::format("{} is a {}, which needs KHR_mesh_quantization in extensionsUsed: "
                              "read as if it were there",
                              semantic, name_of(accessor)));
    }
    if (accessor.view && document.views.at(*accessor.view).stride == 0 &&
        element_bytes(accessor.type, accessor.component) % 4 != 0) {
        notes.add("vertex alignment", place,
                  "elements of vertex attributes must start at multiples of 4 bytes: read all the "
                  "same");
    }
}

void check_indices(const Document& document, const Accessor& indices, const std::string& place,
                   Notes& notes) {
    const bool is_unsigned = indices.component == Component::Uint8 ||
                             indices.component == Component::Uint16 ||
                             indices.component == Component::Uint32;
    if (indices.type != ElementType::Scalar || !is_unsigned || indices.normalized) {
        refuse(place, fmt::format("indices cannot be a {}", name_of(indices)));
    }
    if (indices.view && document.views.at(*indices.view).stride != 0) {
        notes.add("index stride", place,
                  "the view of indices has a byteStride, against the standard");
    }
}

void check_primitive(const Document& document, const PrimitiveSource& primitive,
                     const std::string& place, Notes& notes) {
    std::optional<std::pair<std::string, std::uint64_t>> first;
    for (const auto& [semantic, index] : primitive.attributes) {
        const Accessor& accessor = document.accessors.at(index);
        const std::string at = fmt::format("{}/attributes/{}", place, semantic);
        check_attribute(document, semantic, accessor, at, notes);
        if (!first) {
            first = {semantic, accessor.count};
        } else if (first->second != accessor.count) {
            refuse(at, fmt::format("has {} elements, {} has {}", accessor.count, first->first,
                                   first->second));
        }
    }
    if (primitive.indices) {
        check_indices(document, document.accessors.at(*primitive.indices), place + "/indices",
                      notes);
    }
    if (primitive.has_targets) {
        notes.add("targets", place + "/targets",
                  "morph targets are not supported: shown without them");
    }
    const auto position = primitive.attributes.find("POSITION");
    if (position == primitive.attributes.end()) {
        notes.add("no position", place, "has no POSITION: not shown");
    } else if (document.accessors.at(position->second).min.empty() ||
               document.accessors.at(position->second).max.empty()) {
        notes.add("position bounds", fmt::format("/accessors/{}", position->second),
                  "is a POSITION and lacks min or max");
    }
}

// ---- nodes --------------------------------------------------------------------------------------

void check_trees(const Document& document) {
    constexpr std::uint32_t kNoParent = mesh::kNone;
    std::vector<std::uint32_t> parents(document.nodes.size(), kNoParent);
    for (std::uint32_t i = 0; i < document.nodes.size(); ++i) {
        for (std::size_t c = 0; c < document.nodes[i].children.size(); ++c) {
            const std::uint32_t child = document.nodes[i].children[c];
            if (parents[child] != kNoParent || child == i) {
                refuse(fmt::format("/nodes/{}/children/{}", i, c),
                       child == i
                           ? "node is its own child"
                           : fmt::format("node {} is a child of node {} already; a node has one "
                                         "parent, so instance the mesh with further nodes",
                                         child, parents[child]));
            }
            parents[child] = i;
        }
    }
    // With one parent each, what is not reached from nodes without a parent lies on a circle.
    std::vector<bool> reached(document.nodes.size(), false);
    std::vector<std::uint32_t> open;
    for (std::uint32_t i = 0; i < parents.size(); ++i) {
        if (parents[i] == kNoParent) {
            open.push_back(i);
        }
    }
    while (!open.empty()) {
        const std::uint32_t node = open.back();
        open.pop_back();
        reached[node] = true;
        open.insert(open.end(), document.nodes[node].children.begin(),
                    document.nodes[node].children.end());
    }
    if (const auto lost = std::ranges::find(reached, false); lost != reached.end()) {
        const auto node = static_cast<std::size_t>(lost - reached.begin());
        refuse(fmt::format("/nodes/{}", node),
               fmt::format("is its own ancestor (its parent is node {})", parents[node]));
    }
    std::vector<bool> is_root(document.nodes.size(), false);
    for (std::size_t i = 0; i < document.roots.size(); ++i) {
        const std::uint32_t root = document.roots[i];
        if (is_root[root]) {
            refuse("/scenes", fmt::format("node {} is listed twice", root));
        }
        is_root[root] = true;
        if (parents[root] != kNoParent) {
            refuse(fmt::format("/nodes/{}", root),
                   fmt::format("is listed by the scene, and is a child of node {}: a scene lists "
                               "nodes without parents alone",
                               parents[root]));
        }
    }
}

}  // namespace

void check_document(const Document& document, Notes& notes) {
    check_views(document);
    for (std::size_t i = 0; i < document.accessors.size(); ++i) {
        check_accessor(document, document.accessors[i], fmt::format("/accessors/{}", i), notes);
    }
    for (std::size_t m = 0; m < document.meshes.size(); ++m) {
        for (std::size_t p = 0; p < document.meshes[m].primitives.size(); ++p) {
            check_primitive(document, document.meshes[m].primitives[p],
                            fmt::format("/meshes/{}/primitives/{}", m, p), notes);
        }
    }
    check_trees(document);
}

}  // namespace gazeloop::scene::gltf
