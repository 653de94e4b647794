// The ray-marched scene: an open-air gallery of signed distances in the sun.
//
//   vec4 scene_radiance(vec3 origin_m, vec3 direction, float spacing_rad, float time_s)
//
// origin_m   metres, OpenXR axes (+X right, +Y up, -Z forward). Made to be seen from within half a
//            metre of the world's origin, which is 1.4 m above the floor; finite from anywhere.
// direction  unit vector, any.
// spacing_rad  how far apart samples lie: detail of the floor that is finer fades.
// time_s     seconds. The scene repeats exactly every 64 s.
// returns    linear radiance, Rec.709 primaries, 0 to 4 (a white wall that faces the sun has 1.3);
//            and 1 / distance of what is seen first, 1/m, 0 for the sky.
//
// scene_sample() answers that as lib/scene.glsl asks; motion is that of the head, as if nothing in
// the scene moved by itself.
//
// Needs GL_GOOGLE_include_directive and lib/scene.glsl; uses no binding of its own. Every other name that it brings starts with
// scene_, Scene, SCENE_, material_ or distance_to_, or ends in _stage.
#ifndef GAZELOOP_RAYMARCH_GLSL
#define GAZELOOP_RAYMARCH_GLSL

#include "raymarch_march.glsl"
#include "raymarch_surroundings.glsl"

// Whether detail that is finer than the samples lie apart fades, or only what is finer than the
// densest samples.
layout(constant_id = 16) const bool kSceneFootprint = false;

// What the surface itself sends back along the ray, mirroring and haze apart.
vec3 scene_shade(SceneRay ray, SceneHit hit, vec3 normal, vec3 albedo, SceneLight light) {
    vec3 halfway = scene_to_sun - ray.direction;
    float gleam = max(dot(normal, halfway), 0.0);
    gleam = gleam * gleam / max(dot(halfway, halfway), 1e-6);
    gleam *= gleam;
    gleam *= gleam;
    gleam *= gleam;
    gleam *= hit.is_object ? 0.15 * gleam : 0.0;
    vec3 irradiance = scene_sun * max(dot(normal, scene_to_sun), 0.0) * light.sun;
    vec3 from_around = mix(scene_light_from_below, scene_light_from_above, 0.5 + 0.5 * normal.y);
    return albedo * (irradiance + from_around * light.sky) + gleam * irradiance;
}

vec4 scene_radiance(vec3 origin_m, vec3 direction, float spacing_rad, float time_s) {
    SceneClock clock = scene_clock(time_s);
    SceneRay ray = scene_ray(origin_m, direction);
    vec3 radiance = vec3(0.0);
    vec3 carried = vec3(1.0);
    float nearness = 0.0;

    // Twice round only where the first surface mirrors; elsewhere the work ends with the loop.
    for (int bounce = 0; bounce < 2; ++bounce) {
        SceneHit hit = scene_first_hit(ray, clock);
        vec3 sky = scene_sky_radiance(ray.direction);

        vec3 at_m = ray.origin_m + hit.t_m * ray.direction;
        vec3 normal = hit.gradient * inversesqrt(max(dot(hit.gradient, hit.gradient), 1e-20));
        vec4 material = unpackUnorm4x8(hit.material);
        float spread = bounce == 0 ? 1.0 : scene_mirror_spread;
        float footprint_m = spread * spacing_rad * hit.t_m / max(-ray.direction.y, 0.01);
        vec3 albedo = hit.is_object ? material.rgb : scene_floor_albedo(at_m.xz, footprint_m);
        float mirrored = bounce == 0 ? material.a : 0.0;

        // Clear of the surface by more than the march was content with.
        vec3 above_m = at_m + normal * (0.002 + 2.0 * scene_hit_distance(hit.t_m));
        bool faces_sun = hit.is_surface && dot(normal, scene_to_sun) > 0.0;
        SceneRay to_sun = scene_ray(above_m, scene_to_sun);
        SceneLight light = scene_light_at(to_sun, normal, faces_sun, clock);

        float haze = hit.t_m * (1.0 / scene_far_m);
        vec3 shaded = mix(scene_shade(ray, hit, normal, albedo, light), sky, haze * haze);
        radiance += carried * (hit.is_surface ? (1.0 - mirrored) * shaded : sky);

        nearness = bounce == 0 && hit.is_surface ? 1.0 / hit.t_m : nearness;

        if (mirrored == 0.0) {
            break;
        }
        carried = mirrored * albedo;
        ray = scene_ray(above_m, reflect(ray.direction, normal));
    }
    return vec4(radiance, nearness);
}

// How far apart samples lie, along the longer side of their footprint; at least as far as the scene
// is made for.
float scene_spacing_rad(SamplePlace place) {
    if (!kSceneFootprint) {
        return scene_sample_spacing_rad;
    }
    vec2 longest_px2 = vec2(dot(place.footprint_px[0], place.footprint_px[0]),
                            dot(place.footprint_px[1], place.footprint_px[1]));
    float px = sqrt(clamp(max(longest_px2.x, longest_px2.y), 0.0, 1e6));
    vec2 at = place.position_px / image_size();
    vec2 across = vec2(mix(eye.tangents.x, eye.tangents.y, at.x),
                       mix(eye.tangents.z, eye.tangents.w, at.y));
    float rad_per_px = (eye.tangents.y - eye.tangents.x) /
                       (image_size().x * (1.0 + dot(across, across)));
    return max(scene_sample_spacing_rad, px * rad_per_px);
}

SceneSample scene_sample(SamplePlace place, float time_s) {
    vec4 seen = scene_radiance(place.origin_m, place.direction, scene_spacing_rad(place), time_s);
    vec3 point_m = place.origin_m + place.direction / max(seen.a, 1e-6);
    return SceneSample(seen.rgb, seen.a, motion_of_still_px(place.position_px, point_m));
}

#endif
