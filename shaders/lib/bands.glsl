// Which cells a plan needs: columns [x, y) of each band of 4 rows; first the LP-buffer's bands, then
// those of the pixels that are shaded directly (runtime/foveation/picture/band_tiles.h).
layout(std430, set = 2, binding = 4) readonly buffer Bands { uvec2 bands[]; };

bool is_needed(uvec2 cell, uint first_band) {
    uvec2 needed = bands[first_band + (cell.y >> 2u)];
    return cell.x >= needed.x && cell.x < needed.y;
}
