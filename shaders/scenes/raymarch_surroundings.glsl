// What surrounds the stages of the ray-marched scene: sun, sky, and the floor's pattern.
#ifndef GAZELOOP_RAYMARCH_SURROUNDINGS_GLSL
#define GAZELOOP_RAYMARCH_SURROUNDINGS_GLSL

const vec3 scene_to_sun = vec3(-0.6, 0.72, 0.3487119);  // unit; over the viewer's left shoulder

// Irradiance over pi, that is the radiance of a white surface that faces the sun, the zenith, the
// sunlit floor.
const vec3 scene_sun = vec3(1.32, 1.17, 0.94);
const vec3 scene_light_from_above = vec3(0.28, 0.34, 0.46);
const vec3 scene_light_from_below = vec3(0.18, 0.155, 0.13);

// A soft wave of period 1 between 0 and 1.
vec2 scene_wave(vec2 x) {
    vec2 ramp = abs(2.0 * fract(x) - 1.0);
    return ramp * ramp * (3.0 - 2.0 * ramp);
}

// Thin high cloud, 0 to 1: waves bent by waves, on a plane overhead.
float scene_cloud(vec3 direction) {
    vec2 at = direction.xz / (max(direction.y, 0.0) + 0.3);
    vec2 bent = at + 0.45 * scene_wave(0.9 * at.yx + vec2(0.1, 0.4));
    vec2 coarse = scene_wave(vec2(0.7 * bent.x + 0.4 * bent.y, 0.9 * bent.y - 0.5 * bent.x));
    bent += 0.30 * coarse.yx;
    vec2 fine = scene_wave(vec2(2.3 * bent.x - 1.1 * bent.y, 1.7 * bent.y + 1.9 * bent.x));
    float cover = 0.45 * (coarse.x + coarse.y) * (0.4 + 0.6 * fine.x) + 0.22 * fine.y;
    return smoothstep(0.35, 1.0, cover);
}

vec3 scene_sky_radiance(vec3 direction) {
    float low = 1.0 - clamp(direction.y, 0.0, 1.0);
    low *= low;
    vec3 sky = mix(vec3(0.13, 0.25, 0.54), vec3(0.66, 0.68, 0.69), low * low);
    sky = mix(sky, vec3(0.78, 0.77, 0.76), 0.75 * scene_cloud(direction) * (1.0 - low * low));
    float to_sun = clamp(dot(direction, scene_to_sun), 0.0, 1.0);
    float glow = to_sun * to_sun;
    glow *= glow;
    glow *= glow;
    sky += vec3(0.26, 0.19, 0.10) * glow;
    return sky + vec3(2.6, 2.3, 1.8) * smoothstep(0.9988, 0.9992, to_sun);
}

// The finest sampling that the floor is drawn for: about 17 samples per degree. Detail finer than
// one sample fades into its mean; coarser detail stays sharp, and is lost to whoever samples less.
const float scene_sample_spacing_rad = 0.001;
const float scene_mirror_spread = 8.0;  // rays fan out this much faster behind a curved mirror

// How much of a detail of this size is left.
float scene_detail(float size_m, float footprint_m) {
    return 1.0 - smoothstep(0.4 * size_m, 1.2 * size_m, footprint_m);
}

// Slabs of one metre, by turns a checker of 1/16 m and lines of writing in dots of 1/96 m. at_m is
// (x, z); footprint_m the length on the floor that one sample stands for.
vec3 scene_floor_albedo(vec2 at_m, float footprint_m) {
    vec2 slab = floor(at_m);
    vec2 in_slab = at_m - slab;

    vec2 square = floor(in_slab * 16.0);
    float dark = fract(0.5 * (square.x + square.y)) * 2.0;
    dark = mix(0.5, dark, scene_detail(1.0 / 16.0, footprint_m));
    vec3 checker = mix(vec3(0.56, 0.54, 0.50), vec3(0.26, 0.24, 0.22), dark);

    // Letters of 3 x 5 dots in cells of 4 x 8, each from 15 bits of a hash of its place.
    uvec2 dot_at = uvec2(in_slab * 96.0);
    uvec2 letter = dot_at >> uvec2(2u, 3u);
    uvec2 in_letter = dot_at & uvec2(3u, 7u);
    uvec2 page = uvec2(ivec2(slab));
    uint bits = (page.x * 32u + letter.x) * 0x9e3779b1u ^ (page.y * 16u + letter.y) * 0x85ebca6bu;
    bits = (bits ^ (bits >> 15u)) * 0x2c1b3c6du;
    bits ^= bits >> 13u;
    bool in_ink = in_letter.x < 3u && in_letter.y < 5u;
    bool inked = in_ink && ((bits >> (in_letter.y * 3u + in_letter.x)) & 1u) == 1u;
    const float mean_ink = 0.5 * 15.0 / 32.0;
    float ink = mix(mean_ink, inked ? 1.0 : 0.0, scene_detail(1.0 / 96.0, footprint_m));
    vec3 writing = mix(vec3(0.56, 0.53, 0.47), vec3(0.05, 0.06, 0.10), ink);

    vec2 to_edge = min(in_slab, 1.0 - in_slab);
    const float joint_half_m = 0.01;
    bool jointed = min(to_edge.x, to_edge.y) < joint_half_m;
    float joint = jointed ? scene_detail(4.0 * joint_half_m, footprint_m) : 0.0;
    bool written = fract(0.5 * (slab.x + slab.y)) > 0.25;
    return mix(written ? writing : checker, vec3(0.13), joint);
}

#endif
