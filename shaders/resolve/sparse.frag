#version 460
#extension GL_GOOGLE_include_directive : require
// Sparse sampling: every pixel from its nearest samples, or from what was accumulated of them.
#include "../lib/frame.glsl"
#include "../lib/sparse_fill.glsl"
#include "../lib/sparse_accumulated.glsl"
#include "../lib/encode.glsl"
#include "../lib/depth.glsl"

layout(set = 2, binding = 13) uniform sampler2D accumulated;
layout(constant_id = 6) const bool kAccumulated = false;
layout(location = 0) out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 shown = kAccumulated ? texelFetch(accumulated, pixel, 0) : filled_pixel(pixel).seen;
    color = vec4(encoded(shown.rgb), 1.0);
    // What is accumulated has a weight in this channel too.
    set_depth(gl_FragCoord.xy, kAccumulated ? accumulated_nearness(shown.a) : shown.a);
}
