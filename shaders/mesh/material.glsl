// A material and its textures. The C++ side is runtime/scene/mesh_uniforms.h.
layout(std140, set = 1, binding = 0) uniform MaterialUniforms {
    vec4 base_color;
    vec4 factors;      // metallic, roughness, normal scale, occlusion strength
    vec4 emissive;     // w: alpha cutoff
    vec4 more;         // transmission; unused
    vec4 transforms[10];  // two rows for each texture: of (u, v, 1); w: set of coordinates
} material;
layout(set = 1, binding = 1) uniform sampler2D base_color_texture;
layout(set = 1, binding = 2) uniform sampler2D metallic_roughness_texture;
layout(set = 1, binding = 3) uniform sampler2D normal_texture;
layout(set = 1, binding = 4) uniform sampler2D occlusion_texture;
layout(set = 1, binding = 5) uniform sampler2D emissive_texture;

const int kBaseColor = 0;
const int kMetallicRoughness = 1;
const int kNormal = 2;
const int kOcclusion = 3;
const int kEmissive = 4;

// Which textures there are, a bit each: reading one that is not there costs as much as another.
layout(constant_id = 0) const int kTextures = 31;
layout(constant_id = 1) const bool kMasked = false;

bool has_texture(int which) { return ((kTextures >> which) & 1) != 0; }

vec2 texture_place(int which, vec4 uv) {
    vec4 u = material.transforms[2 * which];
    vec4 v = material.transforms[2 * which + 1];
    vec3 at = vec3(mix(uv.xy, uv.zw, u.w), 1.0);
    return vec2(dot(u.xyz, at), dot(v.xyz, at));
}
