#pragma once

#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <vector>

#include "runtime/foveation/picture/band_tiles.h"

namespace gazeloop::foveation {

/// How often each cell is shaded: by every tile that holds it, where its band needs it.
inline std::vector<int> cells_drawn(const std::vector<Columns>& bands,
                                    const std::vector<Tile>& tiles, std::uint32_t width,
                                    std::uint32_t height) {
    std::vector<int> drawn(std::size_t{width} * height, 0);
    for (const Tile& tile : tiles) {
        EXPECT_LT(tile.x0, tile.x1);
        EXPECT_LT(tile.y0, tile.y1);
        EXPECT_LE(tile.x1, width);
        EXPECT_LE(tile.y1, height);
        for (std::uint32_t y = tile.y0; y < tile.y1; ++y) {
            const Columns& needed = bands.at(y / kBandRows);
            for (std::uint32_t x = std::max(tile.x0, needed.first);
                 x < std::min(tile.x1, needed.end); ++x) {
                ++drawn[std::size_t{y} * width + x];
            }
        }
    }
    return drawn;
}

}  // namespace gazeloop::foveation
