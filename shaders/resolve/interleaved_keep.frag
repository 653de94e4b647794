#version 460
#extension GL_GOOGLE_include_directive : require
// Weaves the cells that this frame shaded into what earlier frames left: texels of the LP-buffer, or
// pixels of the disc. A place whose turn it was takes its cell. Any other keeps what was seen there,
// followed as view and gaze move, and held to the cells around where these are not what was kept of
// them. Where nothing was kept, it lies between the cells around.
#include "../lib/frame.glsl"
#include "../lib/log_polar.glsl"
#include "../lib/bands.glsl"
#include "../lib/interleaved.glsl"

layout(set = 2, binding = 8, rgba32f) uniform readonly image2D texel_cells;
layout(set = 2, binding = 9, rgba32f) uniform readonly image2D pixel_cells;
layout(location = 0) out vec4 color;

layout(constant_id = 9) const bool kPixels = false;
layout(constant_id = 11) const bool kHeld = true;  // to the cells around

layout(constant_id = 12) const bool kSharp = true;  // what is kept is resampled by a spline

const vec2 kStrange = vec2(0.4, 0.8);  // from which a place is held a little, and in full

// The four shaded places around a place.
struct Around {
    vec4 between;       // radiance and nearness, interpolated
    vec3 least;
    vec3 most;
    float nearest;      // nearness of the nearest one
    float strangeness;  // the greatest
};

Around cells_around(ivec2 place) {
    ivec2 size = block_size(kPixels);
    ivec2 cells = ivec2(kPixels ? woven.cells.zw : woven.cells.xy);
    vec2 down = vec2(place.y - turn_of(kPixels, 0).y, size.y);
    int top = int(floor(down.x / down.y));
    float share_y = down.x / down.y - float(top);
    Around around = Around(vec4(0.0), vec3(1e30), vec3(0.0), 0.0, 0.0);
    float shares = 0.0;
    float greatest = 0.0;
    for (int j = 0; j < 2; ++j) {
        int y = top + j;
        float across = float(place.x - turn_column(kPixels, y, 0)) / float(size.x);
        int left = int(floor(across));
        float share_x = across - float(left);
        // Rows of the LP-buffer wrap.
        y = kPixels ? y : y < 0 ? y + cells.y : y >= cells.y ? y - cells.y : y;
        bool row_within = y >= 0 && y < cells.y;
        y = clamp(y, 0, cells.y - 1);
        ivec2 needed =
            ivec2(bands[(kPixels ? uint(woven.first_bands.x) : 0u) + (uint(y) >> 2u)]);
        for (int i = 0; i < 2; ++i) {
            ivec2 cell = ivec2(clamp(left + i, 0, cells.x - 1), y);
            float weight = (i == 0 ? 1.0 - share_x : share_x) * (j == 0 ? 1.0 - share_y : share_y);
            bool shaded = row_within && left + i >= needed.x && left + i < needed.y;
            weight = shaded ? weight : 0.0;
            vec4 seen = kPixels ? imageLoad(pixel_cells, cell) : imageLoad(texel_cells, cell);
            if (weight > 0.0) {
                around.between += weight * seen;
                around.least = min(around.least, seen.rgb);
                around.most = max(around.most, seen.rgb);
                around.strangeness = max(around.strangeness, strangeness_of(seen.a));
                around.nearest = weight > greatest ? seen.a : around.nearest;
                greatest = max(greatest, weight);
                shares += weight;
            }
        }
    }
    around.between /= max(shares, 1e-6);
    return around;
}

void main() {
    ivec2 place = ivec2(gl_FragCoord.xy);
    bool needed = is_needed(uvec2(place), uint(kPixels ? woven.first_bands.z : woven.first_bands.y));
    ivec2 cell = place / block_size(kPixels);
    bool its_turn = place == place_of_cell(kPixels, cell, 0);
    int layer = its_turn ? 0 : layer_of_place(kPixels, cell, place);
    bool shaded = its_turn || is_needed(uvec2(cell), first_band_of_layer(kPixels, layer));
    ivec2 own_at = cell + corner_of_layer(kPixels, layer);
    vec4 own = kPixels ? imageLoad(pixel_cells, own_at) : imageLoad(texel_cells, own_at);
    Around around = cells_around(place);
    Kept kept =
        kept_of(kPixels, place, position_of_place(kPixels, place), around.nearest, kSharp);
    float held = kHeld ? smoothstep(kStrange.x, kStrange.y, around.strangeness) : 0.0;
    vec3 in_range = clamp(kept.radiance, around.least, around.most);
    vec4 stays = vec4(mix(kept.radiance, in_range, held),
                      packed_cell(kept.nearness, 1.0 + (kept.seen - 1.0) * (1.0 - held), 0.0));
    vec4 guessed = vec4(around.between.rgb, packed_cell(around.between.a, 0.0, 0.0));
    color = shaded ? own : kept.any ? stays : guessed;
    color = needed ? color : vec4(0.0);
}
