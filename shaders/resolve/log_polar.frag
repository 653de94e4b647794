#version 460
#extension GL_GOOGLE_include_directive : require
// Pass II of kernel foveated rendering: every pixel from the LP-buffer, filtered in linear light, or
// inside the disc from its own direct sample, blended across the border inside the disc's radius.
// Rows wrap (the sampler repeats in v), columns end (it clamps in u).
#include "../lib/frame.glsl"
#include "../lib/log_polar.glsl"
#include "../lib/encode.glsl"

layout(set = 0, binding = 5) uniform sampler2D lp_buffer;
layout(set = 0, binding = 6) uniform sampler2D direct_buffer;
layout(location = 0) out vec4 color;

float disc_weight() {
    float radius = eye.lp_and_disc.z;
    float border = eye.lp_and_disc.w;
    float r = distance(gl_FragCoord.xy, eye.fovea_and_log2.xy);
    float t = border > 0.0 ? clamp((radius - r) / border, 0.0, 1.0) : float(r < radius);
    return t * t * (3.0 - 2.0 * t);
}

void main() {
    vec2 at = lp_position(gl_FragCoord.xy) / lp_size();
    // The level is stated: implicit derivatives would jump where the angle wraps.
    vec3 resolved = textureLod(lp_buffer, at, 0.0).rgb;
    vec3 direct = texelFetch(direct_buffer, ivec2(gl_FragCoord.xy), 0).rgb;
    // What the plan left out of either buffer may hold anything, not-a-number too: it is not mixed.
    float weight = disc_weight();
    vec3 mixed = weight <= 0.0 ? resolved : weight >= 1.0 ? direct : mix(resolved, direct, weight);
    color = vec4(encoded(mixed), 1.0);
}
