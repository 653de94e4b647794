// What stands in the ray-marched scene: the clock that moves it, its materials, and five stages.
//
// A stage is a distance function over a few neighbouring exhibits, with a sphere that holds
// whatever of them is above the floor. World metres; the floor is no part of any stage.
#ifndef GAZELOOP_RAYMARCH_STAGES_GLSL
#define GAZELOOP_RAYMARCH_STAGES_GLSL

#include "raymarch_shapes.glsl"

const float scene_floor_m = -1.4;
const float scene_stages_top_m = 0.85;  // no stage but the colonnade reaches higher

// Whatever turns or bobs takes one of these angles, as (cos, sin), named by its period.
struct SceneClock {
    vec2 in_64_s;
    vec2 in_32_s;
    vec2 in_16_s;
    vec2 in_8_s;
};

vec2 scene_twice(vec2 angle) {
    return vec2(angle.x * angle.x - angle.y * angle.y, 2.0 * angle.x * angle.y);
}

SceneClock scene_clock(float time_s) {
    // The product with a power of two and the fraction are exact, however late it is.
    float angle_rad = 6.2831853 * (fract(time_s * (1.0 / 64.0)) - 0.5);
    SceneClock clock;
    clock.in_64_s = -vec2(cos(angle_rad), sin(angle_rad));
    clock.in_32_s = scene_twice(clock.in_64_s);
    clock.in_16_s = scene_twice(clock.in_32_s);
    clock.in_8_s = scene_twice(clock.in_16_s);
    return clock;
}

vec2 scene_turned(vec2 v, vec2 angle) {
    return vec2(angle.x * v.x - angle.y * v.y, angle.y * v.x + angle.x * v.y);
}

// Linear albedo in the low three bytes, red lowest; the share of light that is mirrored in the
// highest.
const uint material_stone = 0x00606a70u;
const uint material_marble = 0x00a0aab0u;
const uint material_slate = 0x0040382eu;
const uint material_chalk = 0x00b4bcc4u;
const uint material_iron = 0x00342c28u;
const uint material_brass = 0x003090c8u;
const uint material_chrome = 0xd8f0ece8u;
const uint material_gold = 0x9050a0f0u;
const uint material_crystal = 0x60c0a030u;
const uint material_coral = 0x002838d8u;
const uint material_cobalt = 0x00b84014u;
const uint material_jade = 0x00509028u;
const uint material_amber = 0x001478e0u;
const uint material_plum = 0x00702858u;

struct SceneSurface {
    float distance_m;
    uint material;
};

// Where only the distance is asked for, the choice of material is dead code.
SceneSurface scene_with(SceneSurface s, float distance_m, uint material) {
    return s.distance_m < distance_m ? s : SceneSurface(distance_m, material);
}

struct SceneBound {
    vec3 centre_m;
    float radius_m;
};

const SceneBound scene_left_bound = SceneBound(vec3(-1.7, -0.7, -3.6), 1.62);
const SceneBound scene_centre_bound = SceneBound(vec3(0.0, -0.7, -3.25), 1.72);
const SceneBound scene_right_bound = SceneBound(vec3(1.75, -0.7, -3.55), 1.6);
const SceneBound scene_rear_bound = SceneBound(vec3(0.0, -0.7, 1.6), 3.4);

// Left: a crystal on a drum, a pyramid under a ball, an egg in a cage.
SceneSurface left_stage(vec3 p, SceneClock clock) {
    vec3 q = p - vec3(-1.25, -0.95, -2.75);
    SceneSurface s = SceneSurface(distance_to_cylinder(q, 0.22, 0.45), material_slate);
    q.y -= 0.82 + 0.05 * clock.in_8_s.x;
    q.xz = scene_turned(q.xz, clock.in_16_s);
    s = scene_with(s, distance_to_octahedron(q * vec3(1.0, 0.77, 1.0), 0.24), material_crystal);

    q = p - vec3(-2.35, -0.1, -3.7);
    s = scene_with(s, distance_to_pyramid(q, vec2(0.4191, 0.9080)), material_amber);
    q.y -= 0.22 + 0.04 * clock.in_16_s.x;
    s = scene_with(s, distance_to_sphere(q, 0.13), material_cobalt);

    q = p - vec3(-1.35, -1.01, -4.35);
    s = scene_with(s, distance_to_rounded_box(q, vec3(0.28, 0.41, 0.28), 0.06), material_chalk);
    q.y -= 0.89;
    q.xz = scene_turned(q.xz, clock.in_64_s);
    s = scene_with(s, distance_to_box_frame(q, vec3(0.3), 0.025, 0.006), material_iron);
    q.xy = scene_turned(q.xy, clock.in_16_s);
    return scene_with(s, distance_to_ellipsoid(q, vec3(0.22, 0.13, 0.13)), material_jade);
}

// Centre: an egg on a stem, a mirror ball in a ring over a cone, an arch.
SceneSurface centre_stage(vec3 p, SceneClock clock) {
    vec3 q = p - vec3(0.36, -1.4, -1.95);
    SceneSurface s = SceneSurface(distance_to_capsule(q, 0.62, 0.025), material_iron);
    q.y -= 0.65;
    s = scene_with(s, distance_to_torus(q, 0.08, 0.02), material_brass);
    q.y -= 0.12;
    s = scene_with(s, distance_to_round_cone(q, 0.07, 0.11, 0.08), material_coral);

    q = p - vec3(0.0, -0.42, -3.0);
    s = scene_with(s, distance_to_cone(q, vec2(0.316, 0.9487615)), material_marble);
    q.y -= 0.37;
    vec3 r = q;
    r.xy = scene_turned(r.xy, clock.in_16_s);
    r.yz = scene_turned(r.yz, clock.in_32_s);
    s = scene_with(s, distance_to_torus(r, 0.46, 0.03), material_brass);
    q.y -= 0.04 * clock.in_8_s.y;
    s = scene_with(s, distance_to_sphere(q, 0.3), material_chrome);

    q = p - vec3(0.0, -1.4, -4.3);
    return scene_with(s, distance_to_capped_torus(q, vec2(1.0, 0.0), 0.95, 0.1), material_stone);
}

// Right: two links of a chain, a horseshoe with a ball, a family of three.
SceneSurface right_stage(vec3 p, SceneClock clock) {
    vec3 q = p - vec3(1.2, -0.99, -2.6);
    SceneSurface s = SceneSurface(distance_to_hexagonal_prism(q, 0.22, 0.41), material_stone);
    q.y -= 0.72;
    q.xz = scene_turned(q.xz, clock.in_32_s);
    s = scene_with(s, distance_to_link(q, 0.09, 0.12, 0.035), material_gold);
    q.y -= 0.28;
    s = scene_with(s, distance_to_link(q.zyx, 0.09, 0.12, 0.035), material_coral);

    q = p - vec3(1.3, -1.04, -4.4);
    s = scene_with(s, distance_to_triangular_prism(q, 0.2, 0.36), material_plum);
    q.y -= 0.8;
    vec3 r = q;
    r.xz = scene_turned(r.xz, clock.in_64_s);
    r.y = -r.y;
    s = scene_with(s, distance_to_capped_torus(r, vec2(0.8, -0.6), 0.33, 0.06), material_coral);
    q.y -= 0.04 + 0.08 * clock.in_8_s.y;
    s = scene_with(s, distance_to_sphere(q, 0.11), material_amber);

    q = p - vec3(2.4, -1.13, -3.7);
    s = scene_with(s, distance_to_round_cone(q, 0.75, 0.3, 0.15), material_cobalt);
    q = p - vec3(1.95, -1.22, -3.45);
    s = scene_with(s, distance_to_round_cone(q, 0.4, 0.2, 0.11), material_jade);
    q = p - vec3(2.3, -1.27, -3.15);
    float height_m = 0.18 + 0.04 * clock.in_8_s.x;
    return scene_with(s, distance_to_capsule(q, height_m, 0.13), material_coral);
}

// Behind and to the sides: a slab under a ring; in pairs, a framed block and a tree.
SceneSurface rear_stage(vec3 p, SceneClock clock) {
    vec3 q = p - vec3(0.3, -0.7, 3.2);
    q.xz = scene_turned(q.xz, vec2(0.8, 0.6));
    SceneSurface s = SceneSurface(distance_to_box(q, vec3(0.35, 0.7, 0.12)), material_slate);
    q = p - vec3(0.3, 0.35, 3.2);
    q.xy = scene_turned(q.xy, clock.in_32_s);
    s = scene_with(s, distance_to_torus(q, 0.28, 0.07), material_chalk);

    p.x = abs(p.x);
    q = p - vec3(2.7, -0.95, 0.8);
    s = scene_with(s, distance_to_rounded_box(q, vec3(0.3, 0.45, 0.3), 0.12), material_jade);
    q.y -= 0.95;
    q.xz = scene_turned(q.xz, clock.in_32_s);
    s = scene_with(s, distance_to_box_frame(q, vec3(0.3), 0.03, 0.008), material_brass);

    q = p - vec3(1.7, -1.4, 2.7);
    s = scene_with(s, distance_to_capsule(q, 0.8, 0.05), material_iron);
    q.y -= 1.15 + 0.05 * clock.in_16_s.y;
    return scene_with(s, distance_to_ellipsoid(q, vec3(0.34, 0.42, 0.34)), material_plum);
}

const float scene_colonnade_m = 8.0;        // radius of the circle on which it stands
const float scene_colonnade_half_m = 0.55;  // half the depth of the ring that holds it
const float scene_colonnade_top_m = 2.4;

// All around: sixteen columns under a ring.
SceneSurface colonnade_stage(vec3 p, SceneClock clock) {
    float from_circle = abs(length(p.xz) - scene_colonnade_m);
    float lintel = distance_to_extrusion(from_circle - 0.28, abs(p.y - 2.05) - 0.2);
    SceneSurface s = SceneSurface(lintel, material_chalk);

    // Folded at 0, 90, 45 and 22.5 degrees into the sector of one column. The folds lie half-way
    // between columns, so that the nearest column is always the one in the sector.
    vec2 q = abs(p.xz);
    q = vec2(max(q.x, q.y), min(q.x, q.y));
    const vec2 fold = vec2(-0.38268343, 0.92387953);
    q -= 2.0 * max(dot(q, fold), 0.0) * fold;
    float from_axis = length(q - scene_colonnade_m * vec2(0.98078528, 0.19509032));
    float shaft = distance_to_extrusion(from_axis - 0.2, abs(p.y - 0.2) - 1.7);
    s = scene_with(s, shaft, material_marble);
    vec2 foot = vec2(max(from_axis - 0.28, 0.0), p.y + 1.3);
    return scene_with(s, length(foot) - 0.08, material_stone);
}

#endif
