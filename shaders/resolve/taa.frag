#version 460
#extension GL_GOOGLE_include_directive : require
// Temporal antialiasing (Karis 2014) of a method's picture: what the last frames left is
// reprojected, held to what lies around now, and mixed with this frame by how dense the samples of
// each are. So the past follows the fovea: where it arrives, this frame's samples soon outweigh the
// sparse ones that were there, and where it leaves, what it saw is kept.
#include "../lib/frame.glsl"
#include "../lib/scene.glsl"
#include "../lib/depth.glsl"
#include "../lib/finish.glsl"

layout(set = 2, binding = 4) uniform sampler2D history;  // w: weight, samples per pixel
layout(location = 0) out vec4 color;

const float kKept = 0.93;  // of the weight, from frame to frame
// How far beyond what lies around now the past may go, over how far that reaches. At 0 the samples of
// one frame, which move from frame to frame, would move what is held to them as much.
const float kSlack = 1.0;

// Colours as displays show them: what is brighter would outweigh all others for long.
vec4 shown_at(ivec2 pixel) { return clamp(texelFetch(shown, pixel, 0), 0.0, 1.0); }

// What nobody saw has no weight: then, the mean of the four pixels around a position that are known.
vec4 history_between(vec2 position) {
    vec2 corner = floor(position - 0.5);
    vec2 share = position - 0.5 - corner;
    ivec2 last = ivec2(image_size()) - 1;
    vec4 sum = vec4(0.0);
    for (int tap = 0; tap < 4; ++tap) {
        ivec2 aside = ivec2(tap & 1, tap >> 1);
        vec4 was = texelFetch(history, clamp(ivec2(corner) + aside, ivec2(0), last), 0);
        vec2 part = mix(1.0 - share, share, vec2(aside));
        float weight = part.x * part.y * was.a;
        sum += weight > 0.0 ? vec4(weight * was.rgb, weight) : vec4(0.0);
    }
    return vec4(sum.rgb / max(sum.a, 1e-9), sum.a);
}

// The past at a position, and its weight: by Catmull-Rom's cubic over 4 x 4 pixels, because a mean of
// four, taken anew in each frame, would blur what is carried along by a pixel.
vec4 history_at(vec2 position) {
    vec2 corner = floor(position - 0.5);
    vec2 f = position - 0.5 - corner;
    ivec2 last = ivec2(image_size()) - 1;
    mat4x2 parts = mat4x2(f * (-0.5 + f * (1.0 - 0.5 * f)), 1.0 + f * f * (1.5 * f - 2.5),
                          f * (0.5 + f * (2.0 - 1.5 * f)), f * f * (0.5 * f - 0.5));
    vec3 sum = vec3(0.0);
    bool known = true;
    for (int y = 0; y < 4; ++y) {
        for (int x = 0; x < 4; ++x) {
            vec4 was = texelFetch(
                history, clamp(ivec2(corner) + ivec2(x, y) - 1, ivec2(0), last), 0);
            known = known && was.a > 0.0;
            sum += parts[x].x * parts[y].y * was.rgb;
        }
    }
    vec4 between = history_between(position);
    // A cubic may fall below what it lies between.
    return known ? vec4(max(sum, vec3(0.0)), between.a) : between;
}

void main() {
    vec2 position = gl_FragCoord.xy;
    ivec2 pixel = ivec2(position);
    ivec2 last = ivec2(image_size()) - 1;
    float spacing = spacing_px(position);
    int reach = int(spacing + 0.5);
    vec4 here = shown_at(pixel);
    vec3 least = here.rgb;
    vec3 most = here.rgb;
    float nearest = texelFetch(shown_depth, pixel, 0).r;
    // Samples, not pixels, are neighbours: between two of them the picture says nothing new.
    for (int i = 0; i < 9; ++i) {
        ivec2 at = clamp(pixel + reach * (ivec2(i % 3, i / 3) - 1), ivec2(0), last);
        vec4 around = shown_at(at);
        least = around.a > 0.0 ? min(least, around.rgb) : least;
        most = around.a > 0.0 ? max(most, around.rgb) : most;
        nearest = max(nearest, texelFetch(shown_depth, at, 0).r);
    }
    // An edge moves with what is nearer.
    float nearness = nearness_of(position, nearest);
    vec3 point_m = eye.camera_and_time.xyz + ray_direction(position) / max(nearness, 1e-6);
    vec2 was = position - motion_of_still_px(position, point_m);
    bool in_sight = finish.sampling.y > 0.0 && all(greaterThanEqual(was, vec2(0.0))) &&
                    all(lessThanEqual(was, image_size()));
    vec4 before = in_sight ? history_at(was) : vec4(0.0);
    float fresh = 1.0 / (spacing * spacing);
    float most_kept = fresh * (kKept / (1.0 - kKept));  // what a long stay leaves
    float kept = min(kKept * before.a, most_kept);
    float weight = kept + fresh;
    // A past of few samples, as where the fovea has just arrived, is held to the dense ones.
    vec3 slack = kSlack * (most - least);
    vec3 held = clamp(before.rgb, least - slack, most + slack);
    color = vec4(mix(here.rgb, held, kept / weight), weight);
}
