// Fills a pixel from its nearest samples, which no gaze changes: the picture is a window of the
// pattern's field.
#include "sparse.glsl"

// One buffer for each neighbour, the nearest first: all in one would be more than a device binds.
layout(std430, set = 2, binding = 3) readonly buffer SparseNearest0 { uint sparse_nearest_0[]; };
layout(std430, set = 2, binding = 4) readonly buffer SparseNearest1 { uint sparse_nearest_1[]; };
layout(std430, set = 2, binding = 5) readonly buffer SparseNearest2 { uint sparse_nearest_2[]; };
layout(std430, set = 2, binding = 6) readonly buffer SparseNearest3 { uint sparse_nearest_3[]; };
layout(std430, set = 2, binding = 7) readonly buffer SparseNearest4 { uint sparse_nearest_4[]; };
layout(std430, set = 2, binding = 8) readonly buffer SparseNearest5 { uint sparse_nearest_5[]; };
layout(std430, set = 2, binding = 9) readonly buffer SparseNearest6 { uint sparse_nearest_6[]; };
layout(std430, set = 2, binding = 10) readonly buffer SparseNearest7 { uint sparse_nearest_7[]; };
layout(set = 2, binding = 11) uniform sampler2D shaded_list;

layout(constant_id = 4) const int kNeighbours = 4;
// Whether samples count less that are not as far away as the nearest one: they show another surface.
layout(constant_id = 5) const bool kDepthGuided = false;

// The k-th nearest sample of a pixel of the pattern. Where k is known, only one of these is left.
uint nearest_sample(int entry, int k) {
    return k == 0   ? sparse_nearest_0[entry]
           : k == 1 ? sparse_nearest_1[entry]
           : k == 2 ? sparse_nearest_2[entry]
           : k == 3 ? sparse_nearest_3[entry]
           : k == 4 ? sparse_nearest_4[entry]
           : k == 5 ? sparse_nearest_5[entry]
           : k == 6 ? sparse_nearest_6[entry]
                    : sparse_nearest_7[entry];
}

// A sample's radiance and nearness, from the list.
vec4 shaded_sample(int sample_index, ivec2 place) {
    ivec2 begin = pattern_row(place.y - first_list_row());
    int item = begin.x + sample_index - begin.y;
    return texelFetch(shaded_list, ivec2(item % kListWidth, item / kListWidth), 0);
}

struct FilledPixel {
    vec4 seen;            // radiance, nearness
    vec2 nearness_range;  // least and greatest of its samples
    float distance_px;    // of its nearest sample
};

// By inverse distance; a pixel that is a sample is that sample.
FilledPixel filled_pixel(ivec2 pixel) {
    ivec2 place = pattern_origin() + pattern_sign() * pixel;
    int entry = place.y * 2 * int(image_size().x) + place.x;
    FilledPixel filled = FilledPixel(vec4(0.0), vec2(1e30, 0.0), 0.0);
    float weights = 0.0;
    float first_nearness = 0.0;
    for (int k = 0; k < kNeighbours; ++k) {
        int sample_index = int(nearest_sample(entry, k));
        ivec2 sample_place = place_in_pattern(sample_index);
        vec4 seen = shaded_sample(sample_index, sample_place);
        float apart_px = length(vec2(sample_place - place));
        filled.distance_px = k == 0 ? apart_px : filled.distance_px;
        first_nearness = k == 0 ? seen.a : first_nearness;
        float weight = 1.0 / max(apart_px, 1e-6);
        if (kDepthGuided) {
            float between = abs(seen.a - first_nearness) /
                            (0.05 * max(seen.a, first_nearness) + 1e-4);
            weight /= 1.0 + between * between;
        }
        filled.nearness_range = vec2(min(filled.nearness_range.x, seen.a),
                                     max(filled.nearness_range.y, seen.a));
        weight = filled.distance_px == 0.0 && k > 0 ? 0.0 : weight;
        filled.seen += weight * seen;
        weights += weight;
    }
    filled.seen /= weights;
    return filled;
}
