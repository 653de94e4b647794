#version 460
#extension GL_GOOGLE_include_directive : require
// Pass II of a log-polar method: every pixel from the LP-buffer, filtered in linear light, or
// inside the disc from its own direct sample, blended across the border inside the disc's radius.
// Rows wrap (the sampler repeats in v), columns end (it clamps in u).
#include "../lib/frame.glsl"
#include "../lib/log_polar.glsl"
#include "../lib/gaze_frame.glsl"
#include "../lib/bands.glsl"
#include "../lib/lp_read.glsl"
#include "../lib/disc.glsl"
#include "../lib/encode.glsl"
#include "../lib/depth.glsl"

layout(set = 2, binding = 5) uniform sampler2D lp_buffer;
layout(set = 2, binding = 6) uniform sampler2D direct_buffer;
layout(location = 0) out vec4 color;

// Drawn over the whole picture without, then over the disc's tiles with it.
layout(constant_id = 3) const bool kDisc = false;
// Places within a pixel at which the LP-buffer is read; more than one where its texels may be finer
// than pixels.
layout(constant_id = 4) const int kFootprintTaps = 1;

vec2 share_of(vec2 position_px) {
    return kInGazeFrame ? gaze_lp_share(position_px) : lp_share(position_px);
}

// The mean over the pixel, of samples that lie aside in their texels.
vec4 over_footprint(vec2 centre) {
    vec2 aside = kJittered ? eye.image.zw / lp_size() : vec2(0.0);
    LpRead all = LpRead(vec4(0.0), 0.0);
    for (int tap = 0; tap < kFootprintTaps; ++tap) {
        // The Hammersley set, its mean in the pixel's centre.
        vec2 offset = vec2((float(tap) + 0.5) / float(kFootprintTaps),
                           float(bitfieldReverse(uint(tap))) * exp2(-32.0) +
                               0.5 / float(kFootprintTaps)) -
                      0.5;
        vec2 position = gl_FragCoord.xy + (kFootprintTaps > 1 ? offset : vec2(0.0));
        vec2 at = kFootprintTaps > 1 ? share_of(position) : centre;
        LpRead read = lp_read(lp_buffer, at - aside);
        all.sum += read.sum;
        all.weight += read.weight;
    }
    // The pixel's own place is always planned.
    return all.weight > 1e-3 ? all.sum / all.weight : textureLod(lp_buffer, centre, 0.0);
}

void main() {
    vec2 at = share_of(gl_FragCoord.xy);
    // The level is stated: implicit derivatives would jump where the angle wraps.
    vec4 resolved = kJittered || kFootprintTaps > 1 ? over_footprint(at)
                                                    : textureLod(lp_buffer, at, 0.0);
    if (kDisc) {
        resolved =
            blended_with_disc(resolved, texelFetch(direct_buffer, ivec2(gl_FragCoord.xy), 0));
    }
    color = vec4(encoded(resolved.rgb), 1.0);
    set_depth(gl_FragCoord.xy, resolved.a);
}
