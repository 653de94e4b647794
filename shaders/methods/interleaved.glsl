// Shades the cells of an interleaved method: of each block the texel of the LP-buffer or, for the
// disc, the pixel whose turn it is, by its own samples. What was kept of the same surface is a mean
// over earlier visits, which this one enters as far as it agrees. As methods/log_polar.glsl says,
// one shader serves both, and what is left out is discarded last.
#include "../lib/log_polar.glsl"
#include "../lib/bands.glsl"
#include "../lib/interleaved.glsl"

layout(location = 0) flat in int direct;
layout(location = 0) out vec4 color;

const float kMeanDiffers = 0.5;   // means of visits, over the range of one's samples
const vec2 kAgrees = vec2(0.15, 0.4);  // strangeness up to which visits count in full, and not at all

void main() {
    bool pixels = (direct & 1) != 0;
    int layer = direct >> 1;
    ivec2 cell = ivec2(gl_FragCoord.xy) - corner_of_layer(pixels, layer);
    bool needed = is_needed(uvec2(cell), first_band_of_layer(pixels, layer));
    ivec2 place = place_of_cell(pixels, cell, layer);
    ivec2 texel = min(place, ivec2(lp_size()) - 1);
    vec2 row = row_table[texel.y];
    vec3 radii = column_radii(texel.x);
    // A texel stands for itself, however far apart those lie whose turn it is.
    vec2 centre = position_of_texel(texel);
    ivec2 last = ivec2(lp_size()) - 1;
    mat2 texel_px = mat2(position_of_texel(min(texel + ivec2(1, 0), last)) - centre,
                         position_of_texel(ivec2(texel.x, texel.y < last.y ? texel.y + 1 : 0)) - centre);
    mat2 footprint = pixels ? kPixel : texel_px;
    int samples = needed ? kSamples : 0;
    vec4 sum = vec4(0.0);
    vec3 least = vec3(kGreatestRadiance);
    vec3 most = vec3(0.0);
    for (int s = 0; s < samples; ++s) {
        vec4 offset = woven.texel_offsets[s];
        vec2 position = vec2(place) + 0.5 + woven.pixel_offsets[s].xy;
        position = pixels ? position
                          : picture_position(radius_at(radii, offset.x),
                                             direction_at(row, offset.zw));
        vec3 ray = ray_direction(position);
        SceneSample seen = scene_sample(SamplePlace(position, eye.camera_and_time.xyz, ray, footprint),
                                        eye.camera_and_time.w);
        sum += vec4(seen.radiance, seen.nearness);
        least = min(least, seen.radiance);
        most = max(most, seen.radiance);
    }
    vec4 fresh = min(sum / float(kSamples), kGreatestRadiance);
    Kept kept = kept_of(pixels, place, position_of_place(pixels, place), fresh.a, false);
    // Where samples of one visit differ, as along an edge, so do visits.
    vec3 expected = kMeanDiffers * max(most - least, 0.0);
    float apart = kept.any ? strangeness(fresh.rgb, kept.radiance, expected) : 0.0;
    float agreeing = kept.any ? 1.0 - smoothstep(kAgrees.x, kAgrees.y, apart) : 0.0;
    float visits = floor(min((kept.seen - 1.0) * agreeing, woven.before.y - 1.0));
    vec3 mean = visits > 0.0 ? mix(kept.radiance, fresh.rgb, 1.0 / (visits + 1.0)) : fresh.rgb;
    if (!needed) {
        discard;
    }
    color = vec4(mean, packed_cell(fresh.a, visits + 2.0, apart));
}
