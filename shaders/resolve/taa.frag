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

const float kKept = 0.9;  // of the weight, from frame to frame

// Colours as displays show them: what is brighter would outweigh all others for long.
vec4 shown_at(ivec2 pixel) { return clamp(texelFetch(shown, pixel, 0), 0.0, 1.0); }

// The mean of the four pixels around a position, and their weight. What nobody saw has none.
vec4 history_at(vec2 position) {
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
    // At most what a long stay leaves.
    float kept = min(kKept * before.a, fresh * (kKept / (1.0 - kKept)));
    float weight = kept + fresh;
    color = vec4(mix(here.rgb, clamp(before.rgb, least, most), kept / weight), weight);
}
