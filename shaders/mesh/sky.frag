#version 460
#extension GL_GOOGLE_include_directive : require
// The sky, where nothing was drawn: radiance that no light changes.
#include "../lib/g_buffer.glsl"
#include "view.glsl"

layout(set = 1, binding = 0) uniform samplerCube sky;
layout(location = 0) out uvec4 packed;

void main() {
    vec2 at = gl_FragCoord.xy / view.size.xy;
    vec3 local = vec3(mix(view.tangents.x, view.tangents.y, at.x),
                      mix(view.tangents.z, view.tangents.w, at.y), -1.0);
    vec3 direction = normalize(view.axes[0].xyz * local.x + view.axes[1].xyz * local.y +
                               view.axes[2].xyz * local.z);
    vec3 radiance = textureLod(sky, direction, 0.0).rgb;
    float from_sun = dot(direction, view.to_sun.xyz);
    float disc = smoothstep(view.to_sun.w, mix(view.to_sun.w, 1.0, 0.4), from_sun);
    float glow = pow(max(from_sun, 0.0), 400.0);
    radiance += view.sun.rgb * (disc + 0.02 * glow);
    packed = uvec4(0u, 0u, kKindUnlit << 24, packed_radiance(radiance));
}
