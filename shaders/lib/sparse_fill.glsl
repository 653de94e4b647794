// Fills a pixel from its nearest samples, which no gaze changes: the picture is a window of the
// pattern's field.
#include "sparse.glsl"

layout(std430, set = 2, binding = 3) readonly buffer SparseNearest { uint sparse_nearest[]; };
layout(set = 2, binding = 4) uniform sampler2D shaded_list;

layout(constant_id = 4) const int kNeighbours = 4;
// Whether samples count less that are not as far away as the nearest one: they show another surface.
layout(constant_id = 5) const bool kDepthGuided = false;

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
    int entry = (place.y * 2 * int(image_size().x) + place.x) * kNeighbours;
    FilledPixel filled = FilledPixel(vec4(0.0), vec2(1e30, 0.0), 0.0);
    float weights = 0.0;
    float first_nearness = 0.0;
    for (int k = 0; k < kNeighbours; ++k) {
        int sample_index = int(sparse_nearest[entry + k]);
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
