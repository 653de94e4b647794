// Which pixels get which rate (foveation::RingsPlan): for each 4 rows of the picture the columns
// [x, y) of one sample per pixel, of at least one per 2 x 2 pixels, and of what is visible.
layout(std430, set = 2, binding = 1) readonly buffer RingTable { uvec2 ring_table[]; };

bool is_between(uint x, uvec2 columns) { return x >= columns.x && x < columns.y; }

// log2 of the pixels per sample, each way: 0, 1 or 2; 3 where no eye sees the pixel.
uint log2_rate_of(uvec2 pixel) {
    uint row = 3u * (pixel.y >> 2u);
    uint rate = is_between(pixel.x, ring_table[row]) ? 0u
              : is_between(pixel.x, ring_table[row + 1u]) ? 1u
                                                          : 2u;
    return is_between(pixel.x, ring_table[row + 2u]) ? rate : 3u;
}
