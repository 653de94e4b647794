// Rays through the stages of the ray-marched scene: what they meet, and what light arrives there.
//
// Each stage has a march of its own, over the part of the ray that its bound holds. A processor
// that runs several rays in step pays for each stage once, and beyond that only for the stages that
// one of its rays crosses. A single march over everything would pay for every stage at every step.
// Few stages with several exhibits each are best: the cost of a loop is in having it at all.
#ifndef GAZELOOP_RAYMARCH_MARCH_GLSL
#define GAZELOOP_RAYMARCH_MARCH_GLSL

#include "raymarch_stages.glsl"

const float scene_far_m = 40.0;
const int scene_march_steps = 96;
const int scene_shadow_steps = 32;
const int scene_normal_taps = 4;
const int scene_occlusion_taps = 5;

struct SceneRay {
    vec3 origin_m;
    vec3 direction;
    float limit_m;  // past here it is above every stage but the colonnade, or out of sight
};

SceneRay scene_ray(vec3 origin_m, vec3 direction) {
    float rise_m = max(scene_stages_top_m - origin_m.y, 0.0);
    float limit_m = direction.y > 0.0 ? min(rise_m / direction.y, scene_far_m) : scene_far_m;
    return SceneRay(origin_m, direction, limit_m);
}

// Where the ray is inside a bound that widens by spread per metre: (start, end) in metres, empty if
// start >= end.
vec2 scene_span(SceneRay ray, SceneBound bound, float spread, float end_m) {
    vec3 offset = bound.centre_m - ray.origin_m;
    float middle_m = dot(offset, ray.direction);
    float radius_m = bound.radius_m + spread * max(middle_m, 0.0);
    float half_sq = middle_m * middle_m + radius_m * radius_m - dot(offset, offset);
    float half_m = sqrt(max(half_sq, 0.0));
    return vec2(max(middle_m - half_m, 0.0), min(middle_m + half_m, min(ray.limit_m, end_m)));
}

// How far the ray starts from a bound.
float scene_clearance(SceneRay ray, SceneBound bound) {
    return length(ray.origin_m - bound.centre_m) - bound.radius_m;
}

// The span in the colonnade's bound: the wall of a tube, which most rays cross once, from inside.
vec2 scene_span_in_colonnade(SceneRay ray, float end_m) {
    float per_m = 1.0 / max(dot(ray.direction.xz, ray.direction.xz), 1e-6);
    float middle_m = -dot(ray.origin_m.xz, ray.direction.xz) * per_m;
    float from_axis_sq = dot(ray.origin_m.xz, ray.origin_m.xz);
    const float inner_m = scene_colonnade_m - scene_colonnade_half_m;
    const float outer_m = scene_colonnade_m + scene_colonnade_half_m;
    float middle_sq = middle_m * middle_m - from_axis_sq * per_m;
    float inner_half_m = sqrt(max(middle_sq + inner_m * inner_m * per_m, 0.0));
    float outer_half_m = sqrt(max(middle_sq + outer_m * outer_m * per_m, 0.0));
    bool inside = from_axis_sq < inner_m * inner_m;
    float start_m = inside ? middle_m + inner_half_m : max(middle_m - outer_half_m, 0.0);
    float start_height_m = ray.origin_m.y + start_m * ray.direction.y;
    bool over_it = ray.direction.y >= 0.0 && start_height_m > scene_colonnade_top_m;
    return vec2(start_m, over_it ? 0.0 : min(middle_m + outer_half_m, end_m));
}

float scene_clearance_of_colonnade(SceneRay ray) {
    return abs(length(ray.origin_m.xz) - scene_colonnade_m) - scene_colonnade_half_m;
}

struct SceneHit {
    float t_m;        // scene_far_m if there is none
    bool is_surface;  // the floor or an object, not the sky
    bool is_object;
    uint material;  // of an object
    vec3 gradient;  // along the normal, of any length
};

// Near enough to call it a hit: a tenth of a millimetre, and a sixth of a minute of arc.
float scene_hit_distance(float t_m) { return 1e-4 + 5e-5 * t_m; }

// Marches to the surface and, once there, takes the four taps of the normal with the same loop.
// There aside walks through the corners of a tetrahedron; while it is zero it adds nothing to the
// gradient.
#define SCENE_SEEK(STAGE, SPAN)                                                             \
    {                                                                                       \
        vec2 span = SPAN;                                                                   \
        float t = span.x;                                                                   \
        vec3 aside = vec3(0.0);                                                             \
        vec3 gradient = vec3(0.0);                                                          \
        uint material = 0u;                                                                 \
        for (int i = 0; i < scene_march_steps + scene_normal_taps && t < span.y; ++i) {     \
            SceneSurface surface = STAGE(ray.origin_m + t * ray.direction + aside, clock);  \
            gradient += surface.distance_m * aside;                                         \
            material = surface.material;                                                    \
            bool arrived = aside.x != 0.0;                                                  \
            bool close = surface.distance_m < scene_hit_distance(t);                        \
            t += arrived || close ? 0.0 : surface.distance_m;                               \
            aside = arrived ? vec3(-aside.y, aside.x, -aside.z) : vec3(close ? 3e-4 : 0.0); \
            if (arrived && aside.x > 0.0 && aside.y > 0.0) {                                \
                break;                                                                      \
            }                                                                               \
        }                                                                                   \
        if (aside.x != 0.0) {                                                               \
            hit = SceneHit(t, true, true, material, gradient);                              \
        }                                                                                   \
    }

SceneHit scene_first_hit(SceneRay ray, SceneClock clock) {
    float to_floor_m = (ray.origin_m.y - scene_floor_m) / max(-ray.direction.y, 1e-6);
    bool meets_floor = to_floor_m > 0.0 && to_floor_m < scene_far_m;
    float t_m = meets_floor ? to_floor_m : scene_far_m;
    SceneHit hit = SceneHit(t_m, meets_floor, false, 0u, vec3(0.0, 1.0, 0.0));
    SCENE_SEEK(centre_stage, scene_span(ray, scene_centre_bound, 0.0, hit.t_m))
    SCENE_SEEK(left_stage, scene_span(ray, scene_left_bound, 0.0, hit.t_m))
    SCENE_SEEK(right_stage, scene_span(ray, scene_right_bound, 0.0, hit.t_m))
    SCENE_SEEK(rear_stage, scene_span(ray, scene_rear_bound, 0.0, hit.t_m))
    SCENE_SEEK(colonnade_stage, scene_span_in_colonnade(ray, hit.t_m))
    return hit;
}

struct SceneLight {
    float sun;  // share of the sun's disc that is seen
    float sky;  // share of the surroundings
};

const float scene_occlusion_reach_m = 0.5;
const float scene_penumbra = 1.0 / 15.0;  // width of a shadow's edge per metre from what casts it

// First the taps of the occlusion, outermost first: where one finds nothing nearer than the surface
// that it stands on, those below it cannot either. Then the march towards the sun.
#define SCENE_LIGHT(STAGE, SPAN, CLEARANCE_M)                                              \
    {                                                                                      \
        vec2 span = SPAN;                                                                  \
        float h = (CLEARANCE_M) < scene_occlusion_reach_m ? scene_occlusion_reach_m : 0.0; \
        float t = max(span.x, 0.01);                                                       \
        for (int i = 0; i < most_steps && (h > 0.0 || t < span.y); ++i) {                  \
            vec3 away = h > 0.0 ? h * normal : t * ray.direction;                          \
            float distance_m = STAGE(ray.origin_m + away, clock).distance_m;               \
            if (h > 0.0) {                                                                 \
                occlusion += max(h - distance_m, 0.0);                                     \
                h = distance_m < h && h > 1.5 * tap_m ? h - tap_m : 0.0;                   \
            } else {                                                                       \
                sun = min(sun, distance_m / (scene_penumbra * t));                         \
                t = sun > 0.005 ? t + clamp(distance_m, 0.02, 1.0) : scene_far_m;          \
            }                                                                              \
        }                                                                                  \
    }

// ray starts just off the surface and points to the sun.
SceneLight scene_light_at(SceneRay ray, vec3 normal, bool faces_sun, SceneClock clock) {
    const int most_steps = scene_shadow_steps + scene_occlusion_taps;
    const float tap_m = scene_occlusion_reach_m / float(scene_occlusion_taps);
    float end_m = faces_sun ? scene_far_m : 0.0;
    float sun = 1.0;
    float occlusion = 0.0;
    for (int tap = 1; tap <= scene_occlusion_taps; ++tap) {
        float h = tap_m * float(tap);
        occlusion += max(h - distance_to_plane(ray.origin_m + h * normal, scene_floor_m), 0.0);
    }
    SCENE_LIGHT(centre_stage, scene_span(ray, scene_centre_bound, scene_penumbra, end_m),
                scene_clearance(ray, scene_centre_bound))
    SCENE_LIGHT(left_stage, scene_span(ray, scene_left_bound, scene_penumbra, end_m),
                scene_clearance(ray, scene_left_bound))
    SCENE_LIGHT(right_stage, scene_span(ray, scene_right_bound, scene_penumbra, end_m),
                scene_clearance(ray, scene_right_bound))
    SCENE_LIGHT(rear_stage, scene_span(ray, scene_rear_bound, scene_penumbra, end_m),
                scene_clearance(ray, scene_rear_bound))
    SCENE_LIGHT(colonnade_stage, scene_span_in_colonnade(ray, end_m),
                scene_clearance_of_colonnade(ray))
    sun = clamp(sun, 0.0, 1.0);
    return SceneLight(sun * sun * (3.0 - 2.0 * sun), 1.0 / (1.0 + 1.5 * occlusion));
}

#endif
