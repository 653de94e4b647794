// Any bytes as a glTF file, and as every file that it names: an error that names the file, or a
// scene that keeps what MeshData promises.

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstdlib>
#include <glm/geometric.hpp>
#include <span>

#include "runtime/scene/gltf/load_gltf.h"

namespace {

using gazeloop::scene::mesh::MeshData;

void require(bool held) {
    if (!held) {
        std::abort();
    }
}

void require_unit(const glm::vec3& vector) {
    require(std::abs(glm::length(vector) - 1.0F) < 1e-3F);
}

void check_vertices(const MeshData& data) {
    for (const auto& vertex : data.vertices) {
        for (int axis = 0; axis < 3; ++axis) {
            require(std::isfinite(vertex.position_m[axis]));
        }
        require_unit(vertex.normal);
        require_unit(glm::vec3(vertex.tangent));
        require(std::abs(vertex.tangent.w) == 1.0F);
        for (const glm::vec2& uv : vertex.uv) {
            require(std::isfinite(uv.x) && std::isfinite(uv.y));
        }
    }
}

void check_references(const MeshData& data) {
    for (const auto& primitive : data.primitives) {
        require(std::uint64_t{primitive.first_index} + primitive.index_count <=
                data.indices.size());
        require(std::uint64_t{primitive.first_vertex} + primitive.vertex_count <=
                data.vertices.size());
        require(primitive.index_count % 3 == 0 && primitive.material < data.materials.size());
        for (std::uint32_t i = 0; i < primitive.index_count; ++i) {
            require(data.indices[primitive.first_index + i] < primitive.vertex_count);
        }
    }
    for (const auto& level : data.levels) {
        require(level.primitive < data.primitives.size() && std::isfinite(level.error_m));
    }
    require(!data.instances.empty());
    for (const auto& instance : data.instances) {
        require(instance.level_count > 0 &&
                std::uint64_t{instance.first_level} + instance.level_count <= data.levels.size());
    }
    for (const auto& material : data.materials) {
        for (const auto* use :
             {&material.base_color_texture, &material.metallic_roughness_texture,
              &material.normal_texture, &material.occlusion_texture, &material.emissive_texture}) {
            require(use->image == gazeloop::scene::mesh::kNone || use->image < data.images.size());
            require(use->uv_set < 2);
        }
    }
    for (const auto& image : data.images) {
        const std::size_t texel = image.format == gazeloop::scene::mesh::TexelFormat::Rgba8 ? 4 : 8;
        require(image.width > 0 &&
                image.texels.size() == std::size_t{image.width} * image.height * texel);
    }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace gazeloop;
    const auto bytes = std::as_bytes(std::span(data, size));
    const scene::gltf::ReadFile read_file = [&](const std::string&, std::uint64_t most_bytes,
                                                const std::string&, scene::gltf::Bytes& into) {
        const auto part = bytes.first(std::min<std::uint64_t>(bytes.size(), most_bytes));
        into.assign(part.begin(), part.end());
    };
    const auto scene = scene::gltf::load_gltf(
        bytes, "fuzz", read_file,
        {.limits = {.most_texels_per_side = 2048, .most_bytes = std::uint64_t{1} << 24U},
         .mark_broken_pictures = size % 2 == 0,
         .threads = 1});
    if (!scene) {
        require(scene.error().kind == ErrorKind::BadInput &&
                scene.error().message.starts_with("fuzz:"));
        return 0;
    }
    check_vertices(scene->data);
    check_references(scene->data);
    for (const scene::gltf::Note& note : scene->notes) {
        require(!note_text(note).empty());
    }
    return 0;
}
