#include "runtime/scene/mesh_needs.h"

#include <algorithm>

namespace gazeloop::scene {
namespace {

/// Roughness above which reflections show the sky alone (shaders/scenes/mesh.glsl, kGlossy).
constexpr float kGlossy = 0.35F;

}  // namespace

MeshNeeds needs_of(const mesh::MeshData& data, bool all) {
    MeshNeeds needs;
    needs.shadows = data.lights.empty() || std::ranges::any_of(data.lights, [](const auto& light) {
                        return light.casts_shadow && light.kind != mesh::LightKind::Point;
                    });
    needs.glass = std::ranges::any_of(data.materials, [](const mesh::Material& material) {
        return material.transmission > 0.0F || material.alpha_mode == mesh::AlphaMode::Blend;
    });
    needs.reflections = std::ranges::any_of(data.materials, [](const mesh::Material& material) {
        return material.transmission > 0.0F || material.roughness < kGlossy ||
               material.metallic_roughness_texture.image != mesh::kNone;
    });
    if (all) {
        needs = {.depth_first = true,
                 .shadows = true,
                 .shadows_each_frame = true,
                 .glass = true,
                 .reflections = true,
                 .skipped = {}};
        return needs;
    }
    const auto skip = [&](bool needed, const char* what) {
        if (!needed) {
            needs.skipped.emplace_back(what);
        }
    };
    skip(needs.depth_first, "depth (the nearest is drawn first)");
    skip(needs.shadows, "shadow (no light casts any)");
    skip(!needs.shadows || needs.shadows_each_frame,
         "shadow after the first frame (nothing moves)");
    skip(needs.glass, "glass (nothing lets light through)");
    skip(needs.reflections, "reflections of the picture (nothing mirrors)");
    return needs;
}

}  // namespace gazeloop::scene
