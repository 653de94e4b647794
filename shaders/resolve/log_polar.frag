#version 460
#extension GL_GOOGLE_include_directive : require
// Pass II of a log-polar method: every pixel from the LP-buffer, filtered in linear light, or
// inside the disc from its own direct sample, blended across the border inside the disc's radius.
// Rows wrap (the sampler repeats in v), columns end (it clamps in u).
#include "../lib/frame.glsl"
#include "../lib/log_polar.glsl"
#include "../lib/gaze_frame.glsl"
#include "../lib/encode.glsl"
#include "../lib/depth.glsl"

layout(set = 2, binding = 5) uniform sampler2D lp_buffer;
layout(set = 2, binding = 6) uniform sampler2D direct_buffer;
layout(location = 0) out vec4 color;

float disc_weight() {
    float radius = map.lp_and_disc.z;
    float border = map.lp_and_disc.w;
    float r = kInGazeFrame ? sqrt(half_sine_squared(gaze_ray(gl_FragCoord.xy)))
                           : distance(gl_FragCoord.xy, map.fovea_and_log2.xy);
    float t = border > 0.0 ? clamp((radius - r) / border, 0.0, 1.0) : float(r < radius);
    return t * t * (3.0 - 2.0 * t);
}

// Drawn over the whole picture without, then over the disc's tiles with it.
layout(constant_id = 3) const bool kDisc = false;

void main() {
    vec2 at = kInGazeFrame ? gaze_lp_share(gl_FragCoord.xy) : lp_share(gl_FragCoord.xy);
    // The level is stated: implicit derivatives would jump where the angle wraps.
    vec4 resolved = textureLod(lp_buffer, at, 0.0);
    if (kDisc) {
        vec4 direct = texelFetch(direct_buffer, ivec2(gl_FragCoord.xy), 0);
        // What the plan left out of either buffer may hold anything, not-a-number too: it is not
        // mixed.
        float weight = disc_weight();
        resolved = weight <= 0.0   ? resolved
                   : weight >= 1.0 ? direct
                                   : mix(resolved, direct, weight);
    }
    color = vec4(encoded(resolved.rgb), 1.0);
    set_depth(gl_FragCoord.xy, resolved.a);
}
