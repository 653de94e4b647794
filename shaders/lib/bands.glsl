// Which cells a plan needs: columns [x, y) of each band of 4 rows; first the LP-buffer's bands, then
// those of the pixels that are shaded directly (runtime/foveation/picture/band_tiles.h).
layout(std430, set = 2, binding = 4) readonly buffer Bands { uvec2 bands[]; };

// The columns that a row needs, [x, y).
uvec2 needed_columns(uint row, uint first_band) { return bands[first_band + (row >> 2u)]; }

bool is_within(uint column, uvec2 columns) { return column >= columns.x && column < columns.y; }

bool is_needed(uvec2 cell, uint first_band) {
    return is_within(cell.x, needed_columns(cell.y, first_band));
}
