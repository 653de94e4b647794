#include "runtime/scene/gltf/material_images.h"

#include <fmt/format.h>

#include <algorithm>

namespace gazeloop::scene::gltf {

std::uint32_t MaterialImages::image_of(std::uint32_t image, mesh::ColorSpace color_space,
                                       const std::string& place) {
    const auto [at, is_new] =
        index_.try_emplace({image, color_space}, static_cast<std::uint32_t>(images_.size()));
    if (is_new) {
        images_.push_back({image, color_space, place});
    }
    return at->second;
}

mesh::TextureUse MaterialImages::use_of(const std::optional<TextureReference>& reference,
                                        mesh::ColorSpace color_space, ShownMaterial& shown) {
    mesh::TextureUse use;
    if (!reference) {
        return use;
    }
    const Texture& texture = document_.textures.at(reference->texture);
    if (!texture.image) {
        notes_.add("texture without source", fmt::format("/textures/{}", reference->texture),
                   "has a picture only by an extension that is not supported: shown without it");
        return use;
    }
    auto slot = std::ranges::find(shown.uv_sets, reference->uv_set);
    if (slot == shown.uv_sets.end()) {
        slot = std::ranges::find(shown.uv_sets, mesh::kNone);
    }
    if (slot == shown.uv_sets.end()) {
        notes_.add("uv sets", reference->place,
                   fmt::format("is its material's third set of texture coordinates (TEXCOORD_{}); "
                               "two are shown: shown without this texture",
                               reference->uv_set));
        return use;
    }
    *slot = reference->uv_set;
    use.uv_set = static_cast<std::uint32_t>(slot - shown.uv_sets.begin());
    use.image = image_of(*texture.image, color_space, reference->place);
    use.transform = reference->transform;
    use.wrap_u = texture.wrap_u;
    use.wrap_v = texture.wrap_v;
    use.nearest = texture.nearest;
    return use;
}

ShownMaterial MaterialImages::show(std::optional<std::uint32_t> index) {
    ShownMaterial shown;
    if (!index) {
        return shown;
    }
    const MaterialSource& source = document_.materials.at(*index);
    shown.material = source.material;
    mesh::Material& material = shown.material;
    using enum mesh::ColorSpace;
    material.base_color_texture = use_of(source.base_color, Srgb, shown);
    material.metallic_roughness_texture = use_of(source.metallic_roughness, Linear, shown);
    material.normal_texture = use_of(source.normal, Linear, shown);
    material.occlusion_texture = use_of(source.occlusion, Linear, shown);
    material.emissive_texture = use_of(source.emissive, Srgb, shown);
    if (material.normal_texture.image != mesh::kNone) {
        shown.tangent_slot = material.normal_texture.uv_set;
    }
    return shown;
}

}  // namespace gazeloop::scene::gltf
