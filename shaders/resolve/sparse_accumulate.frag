#version 460
#extension GL_GOOGLE_include_directive : require
// Sparse sampling over frames: the weighted mean of what this frame fills and of what the last ones
// left of the same surface. A fill weighs the more the nearer its sample is, so that what was
// sampled stays. A pixel that is a sample in this frame is that sample.
#include "../lib/frame.glsl"
#include "../lib/scene.glsl"
#include "../lib/sparse_fill.glsl"
#include "../lib/sparse_accumulated.glsl"

layout(set = 2, binding = 12) uniform sampler2D history;
layout(location = 0) out vec4 color;

const float kKept = 0.95;         // of the weight, from frame to frame
const float kLeastWeight = 0.01;  // of a fill whose sample is far away
const float kOtherSurface = 0.25; // how much farther or nearer another surface is

// The mean of the four cells around a position that show a surface at this distance, and its weight.
vec4 history_at(vec2 position, vec2 nearness_range) {
    vec2 corner = floor(position - 0.5);
    vec2 share = position - 0.5 - corner;
    ivec2 size = ivec2(image_size());
    vec4 sum = vec4(0.0);
    float shares = 0.0;
    for (int tap = 0; tap < 4; ++tap) {
        ivec2 at = ivec2(tap & 1, tap >> 1);
        ivec2 cell = ivec2(corner) + at;
        bool within = all(greaterThanEqual(cell, ivec2(0))) && all(lessThan(cell, size));
        vec4 was = texelFetch(history, clamp(cell, ivec2(0), size - 1), 0);
        float nearness = accumulated_nearness(was.a);
        // Below 0: nothing was drawn there.
        bool same = was.a >= 0.0 && nearness >= nearness_range.x && nearness <= nearness_range.y;
        vec2 part = mix(1.0 - share, share, vec2(at));
        float weight = within && same ? part.x * part.y : 0.0;
        sum += weight > 0.0 ? weight * vec4(was.rgb, accumulated_weight(was.a)) : vec4(0.0);
        shares += weight;
    }
    return vec4(sum.rgb / max(shares, 1e-6), sum.a);
}

void main() {
    vec2 position = gl_FragCoord.xy;
    FilledPixel filled = filled_pixel(ivec2(position));
    vec3 point_m = eye.camera_and_time.xyz + ray_direction(position) / max(filled.seen.a, 1e-6);
    vec2 was = position - motion_of_still_px(position, point_m);
    // The same point as seen from where the eye was.
    vec3 from_last = point_m - eye.last_camera.xyz;
    float closer = filled.seen.a > 0.0
                       ? inversesqrt(max(dot(from_last, from_last), 1e-12)) / filled.seen.a
                       : 1.0;
    vec2 range = filled.nearness_range * closer * vec2(1.0 - kOtherSurface, 1.0 + kOtherSurface) +
                 vec2(-0.004, 0.004);
    vec4 before = history_at(was, range);
    float d2 = filled.distance_px * filled.distance_px;
    float fill = max(1.0 / ((1.0 + d2) * (1.0 + d2) * (1.0 + d2)), kLeastWeight);
    float kept = eye.last_camera.w > 0.0 && d2 > 0.0 ? kKept * before.a : 0.0;
    float weight = kept + fill;
    vec3 mean = kept > 0.0 ? mix(before.rgb, filled.seen.rgb, fill / weight) : filled.seen.rgb;
    color = vec4(mean, accumulated_channel(weight, filled.seen.a));
}
