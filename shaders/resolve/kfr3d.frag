#version 460
#extension GL_GOOGLE_include_directive : require
// Pass II of 3D-KFR: every pixel is the sum of what the regions' LP-buffers hold for it, filtered in
// linear light, or inside the disc its own direct sample. All regions share one map; only the sizes
// of their LP-buffers differ, and places in them are shares of those.
#include "../lib/frame.glsl"
#include "../lib/scene.glsl"
#include "../lib/log_polar.glsl"
#include "../lib/gaze_frame.glsl"
#include "../lib/disc.glsl"
#include "../lib/encode.glsl"
#include "../lib/depth.glsl"
#include "../lib/view_regions.glsl"

layout(set = 2, binding = 5) uniform sampler2D lp_0;
layout(set = 2, binding = 6) uniform sampler2D lp_1;
layout(set = 2, binding = 7) uniform sampler2D lp_2;
layout(set = 2, binding = 8) uniform sampler2D lp_3;
layout(set = 2, binding = 9) uniform sampler2D direct_buffer;
layout(location = 0) out vec4 color;

// Drawn over the whole picture without, then over the disc's tiles with it.
layout(constant_id = 3) const bool kDisc = false;
layout(constant_id = 4) const int kRegions = kMostRegions;

// A region without views was not shaded: its buffer may hold anything.
vec4 of_region(sampler2D lp_buffer, int region, vec2 at) {
    vec4 held = textureLod(lp_buffer, at, 0.0);
    return has_views(region) ? held : vec4(0.0);
}

void main() {
    vec2 at = lp_share(gl_FragCoord.xy);
    vec4 resolved = of_region(lp_0, 0, at);
    if (kRegions > 1) {
        resolved += of_region(lp_1, 1, at);
    }
    if (kRegions > 2) {
        resolved += of_region(lp_2, 2, at);
    }
    if (kRegions > 3) {
        resolved += of_region(lp_3, 3, at);
    }
    if (kDisc) {
        resolved = blended_with_disc(resolved, texelFetch(direct_buffer, ivec2(gl_FragCoord.xy), 0));
    }
    color = vec4(encoded(resolved.rgb), 1.0);
    set_depth(gl_FragCoord.xy, resolved.a);
}
