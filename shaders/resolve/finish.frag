#version 460
#extension GL_GOOGLE_include_directive : require
// The last pass over a picture that is held in linear light: the post filter (Meng et al. 2018,
// Eq. 14), a Gaussian that is wider the farther from the fovea a pixel lies, along one axis at a
// time; the second one encodes. Without a filter it only encodes.
#include "../lib/frame.glsl"
#include "../lib/encode.glsl"
#include "../lib/depth.glsl"
#include "../lib/finish.glsl"

layout(constant_id = 4) const int kLargest = 0;      // size of the filter, odd, px; below 3: none
layout(constant_id = 5) const bool kDownwards = false;
layout(set = 2, binding = 5) uniform sampler2D finished;  // what is filtered
layout(location = 0) out vec4 color;

// As post_filter_size() in runtime/render/post_filter.h.
int filter_size(vec2 position_px) {
    float r = distance(position_px, finish.fovea.xy);
    float share = min(r * finish.fovea.z, 1.0);
    int size = 3 + 2 * int(floor((share - 0.1) / 0.05 + 1e-4));
    return r <= finish.fovea.w || size < 3 ? 1 : min(size, kLargest);
}

void main() {
    ivec2 pixel = ivec2(gl_FragCoord.xy);
    vec4 here = texelFetch(finished, pixel, 0);
    vec3 mean = here.rgb;
    if (kLargest >= 3) {
        ivec2 last = ivec2(image_size()) - 1;
        int size = filter_size(gl_FragCoord.xy);
        float falloff = -8.0 / float(size * size);  // of a standard deviation of size / 4
        vec3 sum = vec3(0.0);
        float weights = 0.0;
        for (int i = -(size / 2); i <= size / 2; ++i) {
            ivec2 at = clamp(pixel + (kDownwards ? ivec2(0, i) : ivec2(i, 0)), ivec2(0), last);
            vec4 other = texelFetch(finished, at, 0);
            // What no eye sees is black, and must not darken what is beside it.
            float weight = other.a > 0.0 ? exp(falloff * float(i * i)) : 0.0;
            sum += weight * clamp(other.rgb, 0.0, 1.0);
            weights += weight;
        }
        mean = weights > 0.0 ? sum / weights : here.rgb;
    }
    color = vec4(encoded(mean), here.a > 0.0 ? 1.0 : 0.0);
    set_depth(gl_FragCoord.xy,
              nearness_of(gl_FragCoord.xy, texelFetch(shown_depth, pixel, 0).r));
}
