#version 460
#extension GL_GOOGLE_include_directive : require
// What a mesh shows, for the lighting that comes after the gaze.
#include "../lib/g_buffer.glsl"
#include "material.glsl"

layout(location = 0) in vec3 world_normal;
layout(location = 1) in vec4 world_tangent;
layout(location = 2) in vec4 both_uv;
layout(location = 3) in vec4 vertex_color;
layout(location = 0) out uvec4 packed;

// A constant, no uniform: what control flow depends on would have lavapipe compile for every draw.
layout(constant_id = 2) const uint kKind = kKindSurface;
layout(constant_id = 3) const bool kSpecularFilter = true;
// The usual packing: occlusion is the red of the texel that holds roughness and metallic.
layout(constant_id = 4) const bool kSharesTexel = false;

vec3 unit_or(vec3 v, vec3 otherwise) {
    float square = dot(v, v);
    return square > 1e-24 ? v * inversesqrt(square) : otherwise;
}

void main() {
    vec4 color = material.base_color * vertex_color;
    if (has_texture(kBaseColor)) {
        color *= texture(base_color_texture, texture_place(kBaseColor, both_uv));
    }
    vec2 rough_metal = material.factors.yx;
    float open = 1.0;
    if (has_texture(kMetallicRoughness)) {
        vec3 texel =
            texture(metallic_roughness_texture, texture_place(kMetallicRoughness, both_uv)).rgb;
        open = texel.r;
        rough_metal *= texel.gb;
    }
    float occlusion = 1.0;
    if (has_texture(kOcclusion)) {
        if (!kSharesTexel) {
            open = texture(occlusion_texture, texture_place(kOcclusion, both_uv)).r;
        }
        occlusion = 1.0 + material.factors.w * (open - 1.0);
    }
    vec3 emitted = material.emissive.rgb;
    if (has_texture(kEmissive)) {
        emitted *= texture(emissive_texture, texture_place(kEmissive, both_uv)).rgb;
    }
    vec3 up = unit_or(world_normal, vec3(0.0, 1.0, 0.0)) * (gl_FrontFacing ? 1.0 : -1.0);
    vec3 normal = up;
    if (has_texture(kNormal)) {
        vec3 bent = 2.0 * texture(normal_texture, texture_place(kNormal, both_uv)).xyz - 1.0;
        bent.xy *= material.factors.z;
        vec3 along = unit_or(world_tangent.xyz - dot(world_tangent.xyz, up) * up, vec3(0.0));
        vec3 across = cross(up, along) * world_tangent.w * (gl_FrontFacing ? 1.0 : -1.0);
        normal = unit_or(bent.x * along + bent.y * across + bent.z * up, up);
    }
    float roughness = clamp(rough_metal.x, 0.0, 1.0);
    if (kSpecularFilter) {
        // A highlight that is narrower than what the normal turns by within a pixel flickers: the
        // lobe is widened by that (Tokuyoshi and Kaplanyan 2019, Eq. 2-4).
        vec3 dx = dFdx(normal);
        vec3 dy = dFdy(normal);
        float variance = min(0.5 * (dot(dx, dx) + dot(dy, dy)) * 0.5, 0.18);
        float alpha = roughness * roughness;
        roughness = sqrt(sqrt(clamp(alpha * alpha + variance, 0.0, 1.0)));
    }
    packed = packed_surface(Surface(clamp(color.rgb, 0.0, 1.0), clamp(occlusion, 0.0, 1.0), normal,
                                    roughness, clamp(rough_metal.y, 0.0, 1.0),
                                    kKind == kKindVeil ? 1.0 - clamp(color.a, 0.0, 1.0)
                                                      : material.more.x,
                                    kKind, emitted));
    if (kMasked && color.a < material.emissive.w) {
        discard;
    }
}
