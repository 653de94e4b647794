#pragma once

#include <cstdint>
#include <span>
#include <vector>

#include "runtime/foveation/tile.h"

namespace gazeloop::foveation {

/// Height of the bands that tiles are made of: software and hardware rasterisers shade in blocks of
/// 2 to 4 rows, so that thinner tiles would leave lanes idle.
inline constexpr std::uint32_t kBandRows = 4;

/// What a band of rows needs: columns [first, end); nothing if they are equal.
struct Columns {
    std::uint32_t first = 0;
    std::uint32_t end = 0;

    [[nodiscard]] bool empty() const { return first >= end; }
};

/// Covers the bands exactly, each cell once, by few large rectangles, and appends these to `tiles`.
/// Band i has the rows [i * kBandRows, min((i + 1) * kBandRows, height)).
///
/// A rectangle is drawn as two triangles, and every block of cells that their common edge crosses
/// is shaded for both: a rectangle one band high would be shaded twice. At most 3 tiles a band.
void append_band_tiles(std::span<const Columns> bands, std::uint32_t height,
                       std::vector<Tile>& tiles);

}  // namespace gazeloop::foveation
