#pragma once

#include <algorithm>
#include <cstdint>
#include <span>
#include <vector>

#include "runtime/foveation/picture/tile.h"

namespace gazeloop::foveation {

/// Height, in rows, of the bands in which a plan says what it needs. Software and hardware
/// rasterisers shade in blocks of 2 to 4 rows, so finer bands would save nothing. A power of two;
/// the same in shaders/lib/bands.glsl.
inline constexpr std::uint32_t kBandRows = 4;

/// Height, in rows, of the tiles that are drawn. A draw costs a software driver about as much as a
/// thousand samples, so tiles are few. What a tile holds beyond its bands is masked.
inline constexpr std::uint32_t kTileRows = 64;

/// What a band of rows needs: columns [first, end); nothing if they are equal.
struct Columns {
    std::uint32_t first = 0;
    std::uint32_t end = 0;

    [[nodiscard]] bool empty() const { return first >= end; }
};

/// What both have; all zero where they have nothing in common.
[[nodiscard]] inline Columns common(const Columns& a, const Columns& b) {
    const Columns both{std::max(a.first, b.first), std::min(a.end, b.end)};
    return both.empty() ? Columns{} : both;
}

/// Appends tiles that together hold every column of every band. Each run of kTileRows rows gets at
/// most one tile, as small as its bands allow. Band i has the rows [i * kBandRows, min((i + 1) *
/// kBandRows, height)).
void append_band_tiles(std::span<const Columns> bands, std::uint32_t height,
                       std::vector<Tile>& tiles);

}  // namespace gazeloop::foveation
