// Sparse sampling: shades the samples of the list, whatever pixels they are. A compacted list, so
// that no lane waits for one that has nothing to do. Neighbours in the list are neighbours in a row
// of the picture.
#include "../lib/sparse.glsl"

layout(location = 0) out vec4 color;

void main() {
    int item = int(gl_FragCoord.y) * kListWidth + int(gl_FragCoord.x);
    bool needed = item < list_length();
    // The last row of the pattern that begins at or before the item.
    int last_row = list_rows() - 1;
    int row = 0;
    for (int reach = 1 << 15; reach > 0; reach >>= 1) {
        int next = min(row + reach, last_row);
        row = pattern_row(next).x <= item ? next : row;
    }
    ivec2 begin = pattern_row(row);
    int sample_index = needed ? begin.y + item - begin.x : 0;
    vec2 pixel = vec2(pixel_of_place(place_in_pattern(sample_index))) + 0.5;
    int samples = needed ? kSamples : 0;
    vec4 sum = vec4(0.0);
    for (int s = 0; s < samples; ++s) {
        vec2 position = pixel + eye.offsets[s].xy;
        SceneSample seen = scene_sample(
            SamplePlace(position, eye.camera_and_time.xyz, ray_direction(position), kPixel),
            eye.camera_and_time.w);
        sum += vec4(seen.radiance, seen.nearness);
    }
    if (!needed) {
        discard;
    }
    color = min(sum / float(kSamples), kGreatestRadiance);
}
