// What a pixel shows, in 128 bits: drawn by mesh/g_buffer.frag and mesh/sky.frag, read by
// scenes/mesh.glsl.
//   x  base colour (square roots, 8 bits each), occlusion
//   y  normal, octahedral, 2 x 16 bits
//   z  roughness, metallic, share let through, kind (8 bits each)
//   w  emitted radiance, 3 x 9 bits with a common exponent
const uint kKindUnlit = 0u;  // its radiance is what it emits
const uint kKindSurface = 1u;
const uint kKindGlass = 2u;  // lets light through and bends it
const uint kKindVeil = 3u;   // lets light through straight

struct Surface {
    vec3 base_color;
    float occlusion;
    vec3 normal;
    float roughness;
    float metallic;
    float transmission;
    uint kind;
    vec3 emitted;
};

vec2 octahedral(vec3 n) {
    vec2 p = n.xy / (abs(n.x) + abs(n.y) + abs(n.z));
    vec2 folded = (1.0 - abs(p.yx)) * vec2(p.x >= 0.0 ? 1.0 : -1.0, p.y >= 0.0 ? 1.0 : -1.0);
    return n.z >= 0.0 ? p : folded;
}

vec3 from_octahedral(vec2 p) {
    vec3 n = vec3(p, 1.0 - abs(p.x) - abs(p.y));
    float t = max(-n.z, 0.0);
    n.xy -= vec2(n.x >= 0.0 ? t : -t, n.y >= 0.0 ? t : -t);
    return normalize(n);
}

const float kGreatestEmission = 65408.0;  // 511 * 2^7

// Shared exponent as in VK_FORMAT_E5B9G9R9_UFLOAT_PACK32 (exponent bias 15).
uint packed_radiance(vec3 c) {
    c = clamp(c, 0.0, kGreatestEmission);
    float greatest = max(max(c.r, c.g), max(c.b, 1.0 / 65536.0));
    // The exponent's bits are the logarithm's floor; one more, so that mantissas stay below 512.
    int exponent = max(-16, int(floatBitsToUint(greatest) >> 23) - 127) + 1;
    float scale = uintBitsToFloat(uint(127 + 9 - exponent) << 23);
    if (floor(greatest * scale + 0.5) > 511.0) {
        exponent += 1;
        scale *= 0.5;
    }
    uvec3 m = uvec3(c * scale + 0.5);
    return m.r | (m.g << 9) | (m.b << 18) | (uint(exponent + 15) << 27);
}

vec3 unpacked_radiance(uint p) {
    float scale = uintBitsToFloat(((p >> 27) + uint(127 - 15 - 9)) << 23);
    return vec3(p & 511u, (p >> 9) & 511u, (p >> 18) & 511u) * scale;
}

uvec4 packed_surface(Surface s) {
    return uvec4(packUnorm4x8(vec4(sqrt(s.base_color), s.occlusion)),
                 packSnorm2x16(octahedral(s.normal)),
                 packUnorm4x8(vec4(s.roughness, s.metallic, s.transmission, 0.0)) |
                     (s.kind << 24),
                 packed_radiance(s.emitted));
}

Surface unpacked_surface(uvec4 p) {
    vec4 color = unpackUnorm4x8(p.x);
    vec4 factors = unpackUnorm4x8(p.z);
    return Surface(color.rgb * color.rgb, color.a, from_octahedral(unpackSnorm2x16(p.y)),
                   factors.x, factors.y, factors.z, p.z >> 24, unpacked_radiance(p.w));
}
