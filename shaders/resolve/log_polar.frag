#version 460
#extension GL_GOOGLE_include_directive : require
// Pass II of a log-polar method: every pixel from the LP-buffer, filtered in linear light, or
// inside the disc from its own direct sample, blended across the border inside the disc's radius.
// Rows wrap (the sampler repeats in v), columns end (it clamps in u).
#include "../lib/frame.glsl"
#include "../lib/log_polar.glsl"
#include "../lib/gaze_frame.glsl"
#include "../lib/disc.glsl"
#include "../lib/encode.glsl"
#include "../lib/depth.glsl"

layout(set = 2, binding = 5) uniform sampler2D lp_buffer;
layout(set = 2, binding = 6) uniform sampler2D direct_buffer;
layout(location = 0) out vec4 color;

// Drawn over the whole picture without, then over the disc's tiles with it.
layout(constant_id = 3) const bool kDisc = false;

void main() {
    vec2 at = kInGazeFrame ? gaze_lp_share(gl_FragCoord.xy) : lp_share(gl_FragCoord.xy);
    // The level is stated: implicit derivatives would jump where the angle wraps.
    vec4 resolved = textureLod(lp_buffer, at, 0.0);
    if (kDisc) {
        resolved =
            blended_with_disc(resolved, texelFetch(direct_buffer, ivec2(gl_FragCoord.xy), 0));
    }
    color = vec4(encoded(resolved.rgb), 1.0);
    set_depth(gl_FragCoord.xy, resolved.a);
}
