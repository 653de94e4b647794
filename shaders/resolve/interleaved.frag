#version 460
#extension GL_GOOGLE_include_directive : require
// Every pixel of an interleaved method, from the LP-buffer's woven texels, filtered by hand because
// not every device filters 32-bit floats, or from the disc's woven pixels, blended across the border.
#include "../lib/frame.glsl"
#include "../lib/log_polar.glsl"
#include "../lib/gaze_frame.glsl"
#include "../lib/disc.glsl"
#include "../lib/encode.glsl"
#include "../lib/depth.glsl"

layout(set = 2, binding = 6, rgba32f) uniform readonly image2D texels;
layout(set = 2, binding = 7, rgba32f) uniform readonly image2D pixels;
layout(location = 0) out vec4 color;

layout(constant_id = 3) const bool kDisc = false;

const float kFarthest = 2e-6;  // 1/m: lib/interleaved.glsl

// Columns end, rows wrap.
vec4 lp_at(vec2 share) {
    ivec2 size = ivec2(lp_size());
    vec2 at = share * lp_size() - 0.5;
    at.x = clamp(at.x, 0.0, lp_size().x - 1.0);
    vec2 corner = floor(at);
    vec2 part = at - corner;
    ivec2 low = ivec2(corner);
    int right = min(low.x + 1, size.x - 1);
    int top = low.y < 0 ? low.y + size.y : low.y;
    int bottom = low.y + 1 >= size.y ? low.y + 1 - size.y : low.y + 1;
    return mix(mix(imageLoad(texels, ivec2(low.x, top)),
                   imageLoad(texels, ivec2(right, top)), part.x),
               mix(imageLoad(texels, ivec2(low.x, bottom)),
                   imageLoad(texels, ivec2(right, bottom)), part.x),
               part.y);
}

void main() {
    vec4 resolved = lp_at(lp_share(gl_FragCoord.xy));
    if (kDisc) {
        resolved = blended_with_disc(resolved, imageLoad(pixels, ivec2(gl_FragCoord.xy)));
    }
    color = vec4(encoded(resolved.rgb), 1.0);
    set_depth(gl_FragCoord.xy, resolved.a > kFarthest ? resolved.a : 0.0);
}
