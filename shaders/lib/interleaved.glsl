// Texels (and the disc's pixels) that take turns: blocks of them are cells, of which each frame
// shades one place; what the others showed is kept (foveation/plans/interleaved_plan.h). Needs
// lib/frame.glsl, log_polar.glsl and bands.glsl. The C++ side is
// InterleavedUniforms in runtime/render/passes/interleaved_passes.cpp.
layout(std140, set = 2, binding = 5) uniform InterleavedUniforms {
    vec4 cells;        // of the LP-buffer: columns, rows; of the picture
    vec4 first_bands;  // of the picture's cells, of texels, of pixels; unused
    vec4 refill_bands; // of the LP-buffer's blocks that are shaded whole, of the picture's; unused
    vec4 before;       // 1, or 0 where nothing is kept; most visits; unused
    vec4 texels_kept;  // the rectangle of the last frame's: first column, row; those after the last
    vec4 pixels_kept;
    vec4 map_before;   // the last frame's map: fovea, px; 1 / (farthest radius)^2; .5 / its log2
    // Places in a block by layer: of texels x, y; of pixels x, y. Layer 0 is that whose turn it is;
    // the others are shaded only where a block is shaded whole.
    vec4 turns[16];
    vec4 layers[16];   // by place in a block, row by row: its layer, of texels, of pixels; unused
    vec4 texel_offsets[16];  // samples in their texel: x, y; cosine and sine of y rows
    vec4 pixel_offsets[16];  // samples in their pixel: x, y; unused
} woven;
layout(set = 2, binding = 6, rgba32f) uniform readonly image2D texels_before;
layout(set = 2, binding = 7, rgba32f) uniform readonly image2D pixels_before;

layout(constant_id = 4) const int kTexelBlockWidth = 1;
layout(constant_id = 5) const int kTexelBlockHeight = 1;
layout(constant_id = 6) const int kPixelBlockWidth = 1;
layout(constant_id = 7) const int kPixelBlockHeight = 1;
// Whether what is kept follows the view and the gaze; else it stays in its cell.
layout(constant_id = 8) const bool kFollows = true;

const float kOnItsCentre = 1.0 / 32.0;  // cells; as near, a cell is taken as it is
const float kCoarser = 2.0;             // side of a kept texel over that of the one it is for
const float kAsidePerCell = 0.75;       // how far aside a kept surface may be seen, cells
const float kFarthest = 2e-6;           // 1/m; as far away is infinitely far

// A cell's fourth channel: nearness, with two numbers of 0 to 15 in its last bits. So it is filtered
// as nearness, to 1 in 2^15.
float packed_cell(float nearness, float seen, float strangeness) {
    uint bits = floatBitsToUint(max(nearness, 0.5 * kFarthest)) & ~255u;
    return uintBitsToFloat(bits | (uint(clamp(seen + 0.5, 0.0, 15.0)) << 4) |
                           uint(clamp(15.0 * strangeness + 0.5, 0.0, 15.0)));
}
// 0: nobody has seen it, it lies between cells around; 1: seen, and moved since; n + 1: the mean of n
// visits.
float seen_of(float packed) { return float((floatBitsToUint(packed) >> 4) & 15u); }
// How far what was shaded is from what was kept of it: 0 alike, 1 nothing in common.
float strangeness_of(float packed) { return float(floatBitsToUint(packed) & 15u) / 15.0; }

ivec2 block_size(bool pixels) {
    return pixels ? ivec2(kPixelBlockWidth, kPixelBlockHeight)
                  : ivec2(kTexelBlockWidth, kTexelBlockHeight);
}
ivec2 grid_size(bool pixels) { return ivec2(pixels ? image_size() : lp_size()); }
ivec2 turn_of(bool pixels, int layer) {
    return ivec2(pixels ? woven.turns[layer].zw : woven.turns[layer].xy);
}

// By how much the places of a row of blocks are shifted.
int shift_of(bool pixels, int cell_row) {
    ivec2 size = block_size(pixels);
    return size.x != size.y ? (cell_row & 1) * (size.x / 2) : 0;
}
// Where in its block a layer's place lies.
int turn_column(bool pixels, int cell_row, int layer) {
    return (turn_of(pixels, layer).x + shift_of(pixels, cell_row)) & (block_size(pixels).x - 1);
}
ivec2 place_of_cell(bool pixels, ivec2 cell, int layer) {
    ivec2 size = block_size(pixels);
    ivec2 place =
        cell * size + ivec2(turn_column(pixels, cell.y, layer), turn_of(pixels, layer).y);
    return min(place, grid_size(pixels) - 1);
}
// The layer of a place in a cell's block.
int layer_of_place(bool pixels, ivec2 cell, ivec2 place) {
    ivec2 size = block_size(pixels);
    ivec2 within = place - cell * size;
    within.x = (within.x - shift_of(pixels, cell.y)) & (size.x - 1);
    vec4 layers = woven.layers[within.y * size.x + within.x];
    return int(pixels ? layers.y : layers.x);
}
// Where a layer begins in the image of cells.
ivec2 corner_of_layer(bool pixels, int layer) {
    int across = block_size(pixels).x;
    return ivec2(layer % across, layer / across) *
           ivec2(pixels ? woven.cells.zw : woven.cells.xy);
}
// Band 0 of a layer's cells.
uint first_band_of_layer(bool pixels, int layer) {
    return layer == 0 ? uint(pixels ? woven.first_bands.x : 0.0)
                      : uint(pixels ? woven.refill_bands.y : woven.refill_bands.x);
}

// The position in the picture of a texel's centre, px.
vec2 position_of_texel(ivec2 texel) {
    return picture_position(column_radii(texel.x).y, row_table[texel.y]);
}
vec2 position_of_place(bool pixels, ivec2 place) {
    return pixels ? vec2(place) + 0.5 : position_of_texel(place);
}

// Where the last frame showed what is seen at a position, so far away; the position itself where
// that was behind the eye, or where there is no last frame. As motion_of_still_px(), but that no
// uniform decides by itself: lavapipe 22.3 compiles anew where one does.
vec2 position_before(vec2 position_px, float nearness) {
    vec3 from_eye = eye.camera_and_time.xyz - eye.last_camera.xyz +
                    ray_direction(position_px) / max(nearness, 1e-6);
    vec3 local = vec3(dot(eye.last_view_axes[0].xyz, from_eye),
                      dot(eye.last_view_axes[1].xyz, from_eye),
                      dot(eye.last_view_axes[2].xyz, from_eye));
    vec4 t = eye.last_tangents;
    vec2 was = (local.xy / max(-local.z, 1e-6) - t.xz) / (t.yw - t.xz) * image_size();
    return local.z < 0.0 ? was : position_px;
}

// As lp_share(), by the last frame's map.
vec2 lp_share_before(vec2 position_px) {
    vec2 d = position_px - woven.map_before.xy;
    return vec2(column_share(dot(d, d) * woven.map_before.z, woven.map_before.w), turns(d));
}

struct Kept {
    bool any;      // whether there is something that can be used
    vec3 radiance;
    float nearness;
    float seen;    // as seen_of()
};

// Weights of Catmull and Rom's spline, by the share between the inner two of four.
vec4 spline_weights(float t) {
    return vec4(t * (-0.5 + t * (1.0 - 0.5 * t)), 1.0 + t * t * (-2.5 + 1.5 * t),
                t * (0.5 + t * (2.0 - 1.5 * t)), t * t * (-0.5 + 0.5 * t));
}

// What the last frame left of what is seen at a place, at this position and about so far away.
// `sharp`: between kept cells by a spline, which blurs far less than lines where it is done again
// with every frame; within what the four around hold, so that it does not overshoot.
Kept kept_of(bool pixels, ivec2 place, vec2 position_px, float nearness, bool sharp) {
    vec2 was = kFollows ? position_before(position_px, nearness) : position_px;
    vec2 at = pixels ? was : lp_share_before(was) * lp_size();
    at = kFollows ? at : vec2(place) + 0.5;
    ivec2 size = grid_size(pixels);
    vec2 corner = floor(at - 0.5);
    vec2 share = at - 0.5 - corner;
    vec2 whole = step(vec2(0.5), share);
    bool resampled = any(greaterThan(abs(share - whole), vec2(kOnItsCentre)));
    share = resampled ? share : whole;
    vec4 across = spline_weights(share.x);
    vec4 down = spline_weights(share.y);
    vec4 sum = vec4(0.0);
    float shares = 0.0;
    float most = 0.0;
    float main_channel = 0.0;
    ivec4 kept_within = ivec4(pixels ? woven.pixels_kept : woven.texels_kept);
    vec3 splined = vec3(0.0);
    bool whole_patch = true;
    vec3 darkest = vec3(kGreatestRadiance);
    vec3 brightest = vec3(0.0);
    for (int j = sharp ? -1 : 0; j <= (sharp ? 2 : 1); ++j) {
        // Rows of the LP-buffer wrap.
        int y = int(corner.y) + j;
        int wrapped = y < 0 ? y + size.y : y >= size.y ? y - size.y : y;
        y = pixels ? y : wrapped;
        bool row_within = y >= kept_within.y && y < kept_within.w;
        y = clamp(y, 0, size.y - 1);
        for (int i = sharp ? -1 : 0; i <= (sharp ? 2 : 1); ++i) {
            int x = int(corner.x) + i;
            ivec2 cell = ivec2(clamp(x, 0, size.x - 1), y);
            vec4 held =
                pixels ? imageLoad(pixels_before, cell) : imageLoad(texels_before, cell);
            bool seen =
                row_within && x >= kept_within.x && x < kept_within.z && seen_of(held.a) > 0.0;
            held = seen ? held : vec4(0.0);
            whole_patch = whole_patch && seen;
            splined += across[i + 1] * down[j + 1] * held.rgb;
            if (i >= 0 && i < 2 && j >= 0 && j < 2) {
                vec2 part = mix(1.0 - share, share, vec2(i, j));
                float weight = seen ? part.x * part.y : 0.0;
                sum += weight * held;
                shares += weight;
                main_channel = weight > most ? held.a : main_channel;
                most = max(most, weight);
                darkest = seen ? min(darkest, held.rgb) : darkest;
                brightest = seen ? max(brightest, held.rgb) : brightest;
            }
        }
    }
    Kept kept;
    kept.radiance = sum.rgb / max(shares, 1e-6);
    if (sharp) {
        kept.radiance =
            resampled && whole_patch ? clamp(splined, darkest, brightest) : kept.radiance;
    }
    kept.nearness = resampled ? sum.a / max(shares, 1e-6) : main_channel;
    kept.seen = resampled ? 1.0 : seen_of(main_channel);
    // From the fovea, by which texels grow, px.
    float far_px = distance(position_px, map.fovea_and_log2.xy);
    float cell_px = pixels ? 1.0 : max(1.0, 6.2831853 * far_px / lp_size().y);
    // Another surface, seen here as the eye moved, lies elsewhere now.
    float aside_px = distance(position_before(position_px, main_channel), was);
    bool same = !kFollows || aside_px <= kAsidePerCell * cell_px;
    // After the gaze has moved, what was seen from the corner of the eye is coarser than what this
    // frame shades.
    float far_before_px = distance(was, woven.map_before.xy);
    bool fine = pixels || !kFollows || !resampled || far_before_px <= kCoarser * far_px;
    // Not by the uniform alone: lavapipe 22.3 compiles anew where that decides, or fails.
    kept.any = shares * woven.before.x > 0.25 && same && fine;
    return kept;
}

// How far two radiances are apart beyond what is expected, [0, 1].
float strangeness(vec3 a, vec3 b, vec3 expected) {
    vec3 apart = max(abs(a - b) - expected, 0.0) / (a + b + 0.05);
    return min(1.0, max(apart.r, max(apart.g, apart.b)));
}
