// Rings: shades the cells of one rate, each a block of 2^rate pixels a side, by its own samples.
// Cells of other rates take no samples and keep what they held. They are discarded last, because
// lavapipe 22.3 is a fifth slower where loops follow a discard.
#include "../lib/rings.glsl"

layout(location = 0) flat in int log2_rate;
layout(location = 0) out vec4 color;

void main() {
    uvec2 cell = uvec2(gl_FragCoord.xy);
    float width = float(1 << log2_rate);
    bool needed = log2_rate_of(cell << uint(log2_rate)) == uint(log2_rate);
    int samples = needed ? kSamples : 0;
    vec4 sum = vec4(0.0);
    for (int s = 0; s < samples; ++s) {
        vec2 position = (gl_FragCoord.xy + eye.offsets[s].xy) * width;
        SceneSample seen = scene_sample(
            SamplePlace(position, eye.camera_and_time.xyz, ray_direction(position),
                        width * kPixel),
            eye.camera_and_time.w);
        sum += vec4(seen.radiance, seen.nearness);
    }
    if (!needed) {
        discard;
    }
    color = min(sum / float(kSamples), kGreatestRadiance);
}
