#version 460
#extension GL_GOOGLE_include_directive : require
// Rings: every pixel from the cell of its rate, as variable-rate shading copies it to all pixels of
// a block.
#include "../lib/frame.glsl"
#include "../lib/rings.glsl"
#include "../lib/encode.glsl"
#include "../lib/depth.glsl"

layout(set = 2, binding = 2) uniform sampler2D rate_1;
layout(set = 2, binding = 3) uniform sampler2D rate_2;
layout(set = 2, binding = 4) uniform sampler2D rate_4;
layout(location = 0) out vec4 color;

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    uint rate = log2_rate_of(uvec2(pixel));
    // What the plan left out may hold anything, not-a-number too: it is not mixed.
    vec4 shown = rate == 0u   ? texelFetch(rate_1, pixel, 0)
                 : rate == 1u ? texelFetch(rate_2, pixel >> 1, 0)
                              : texelFetch(rate_4, pixel >> 2, 0);
    color = vec4(encoded(shown.rgb), 1.0);
    set_depth(gl_FragCoord.xy, shown.a);
}
