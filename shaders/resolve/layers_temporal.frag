#version 460
#extension GL_GOOGLE_include_directive : require
// Antialiasing of a layer over frames: what the last frames left is reprojected, held to what the
// cells around show now, and mixed with this frame's cell. So what moves, is uncovered or changes
// its light leaves no trail.
#include "../lib/frame.glsl"
#include "../lib/layers.glsl"

layout(set = 2, binding = 2) uniform sampler2D history;
layout(set = 2, binding = 3) uniform sampler2D fresh;
layout(location = 0) flat in int layer;
layout(location = 0) out vec4 color;

const float kShareOfThisFrame = 0.1;

void main() {
    SeenLayer now = layers.shown[layer];
    SeenLayer then = layers.before[layer];
    ivec2 cell = ivec2(gl_FragCoord.xy);
    ivec2 last = max(ivec2(now.cells.xy) - 1, ivec2(0));
    vec4 here = texelFetch(fresh, min(cell, last), 0);
    vec3 least = here.rgb;
    vec3 most = here.rgb;
    float nearest = here.a;
    for (int i = 0; i < 9; ++i) {
        ivec2 at = clamp(cell + ivec2(i % 3, i / 3) - 1, ivec2(0), last);
        vec4 around = texelFetch(fresh, at, 0);
        least = min(least, around.rgb);
        most = max(most, around.rgb);
        nearest = max(nearest, around.a);
    }
    // An edge moves with what is nearer.
    vec2 centre = now.covers.xy + gl_FragCoord.xy * now.covers.zw / now.cells.xy;
    vec3 point_m = eye.camera_and_time.xyz + ray_direction(centre) / max(nearest, 1e-6);
    vec2 was = cell_position(then, position_in(then, point_m));
    bool in_sight = then.gaze.w > 0.0 && all(greaterThanEqual(was, vec2(0.0))) &&
                    all(lessThanEqual(was, then.cells.xy));
    vec3 before = clamp(interpolated(history, was, then.cells.xy).rgb, least, most);
    color = vec4(in_sight ? mix(before, here.rgb, kShareOfThisFrame) : here.rgb, here.a);
}
