#include "runtime/scene/mesh_uniforms.h"

#include <algorithm>
#include <cmath>

namespace gazeloop::scene {

TexelKind kind_of(const mesh::Material& material) {
    if (material.transmission > 0.0F) {
        return TexelKind::Glass;
    }
    if (material.alpha_mode == mesh::AlphaMode::Blend) {
        return TexelKind::Veil;
    }
    return material.unlit ? TexelKind::Unlit : TexelKind::Surface;
}

std::array<const mesh::TextureUse*, 5> textures_of(const mesh::Material& material) {
    return {&material.base_color_texture, &material.metallic_roughness_texture,
            &material.normal_texture, &material.occlusion_texture, &material.emissive_texture};
}

MaterialUniforms uniforms_of(const mesh::Material& material) {
    MaterialUniforms uniforms;
    uniforms.base_color = material.base_color;
    uniforms.factors = {material.metallic, material.roughness, material.normal_scale,
                        material.occlusion_strength};
    uniforms.emissive = glm::vec4(material.emissive, material.alpha_cutoff);
    uniforms.more = {material.transmission, 0.0F, 0.0F, 0.0F};
    std::size_t row = 0;
    for (const mesh::TextureUse* use : textures_of(material)) {
        for (int i = 0; i < 2; ++i) {
            uniforms.transforms.at(row++) = {use->transform[0][i], use->transform[1][i],
                                             use->transform[2][i], static_cast<float>(use->uv_set)};
        }
    }
    return uniforms;
}

LightUniforms uniforms_of(const mesh::Light& light) {
    LightUniforms uniforms;
    const bool everywhere = light.kind == mesh::LightKind::Directional;
    uniforms.place =
        everywhere ? glm::vec4(-light.direction, 0.0F) : glm::vec4(light.position_m, 1.0F);
    uniforms.axis = glm::vec4(light.direction, everywhere || std::isinf(light.range_m)
                                                   ? 0.0F
                                                   : 1.0F / (light.range_m * light.range_m));
    uniforms.color = glm::vec4(light.color * light.intensity, 0.0F);
    uniforms.shape = {0.0F, 1.0F, 0.0F, 0.0F};
    if (light.kind == mesh::LightKind::Spot) {
        const float outer = std::cos(light.outer_cone_rad);
        const float scale = 1.0F / std::max(0.001F, std::cos(light.inner_cone_rad) - outer);
        uniforms.shape.x = scale;
        uniforms.shape.y = -outer * scale;
    }
    return uniforms;
}

}  // namespace gazeloop::scene
