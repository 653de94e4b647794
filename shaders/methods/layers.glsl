// Layers: shades the cells of one layer, each by its own samples. Over frames the samples move
// within their cells. Cells that the plan leaves out take no samples and keep what they held. They
// are discarded last, because lavapipe 22.3 is a fifth slower where loops follow a discard.
#include "../lib/layers.glsl"

layout(location = 0) flat in int layer;
layout(location = 0) out vec4 color;

void main() {
    SeenLayer now = layers.shown[layer];
    uvec2 cell = uvec2(gl_FragCoord.xy);
    uvec2 columns = layer_bands[uint(layers.first_band[layer]) + (cell.y >> 2u)];
    bool needed = cell.x >= columns.x && cell.x < columns.y;
    vec2 px_per_cell = now.covers.zw / now.cells.xy;
    int samples = needed ? kSamples : 0;
    vec4 sum = vec4(0.0);
    for (int s = 0; s < samples; ++s) {
        vec2 position = now.covers.xy +
                        (gl_FragCoord.xy + now.cells.zw + eye.offsets[s].xy) * px_per_cell;
        SceneSample seen = scene_sample(
            SamplePlace(position, eye.camera_and_time.xyz, ray_direction(position),
                        mat2(px_per_cell.x, 0.0, 0.0, px_per_cell.y)),
            eye.camera_and_time.w);
        sum += vec4(seen.radiance, seen.nearness);
    }
    if (!needed) {
        discard;
    }
    color = min(sum / float(kSamples), kGreatestRadiance);
}
