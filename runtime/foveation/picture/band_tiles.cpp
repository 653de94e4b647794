#include "runtime/foveation/picture/band_tiles.h"

#include <algorithm>

namespace gazeloop::foveation {

void append_band_tiles(std::span<const Columns> bands, std::uint32_t height,
                       std::vector<Tile>& tiles) {
    constexpr std::size_t kTileBands = kTileRows / kBandRows;
    for (std::size_t begin = 0; begin < bands.size(); begin += kTileBands) {
        const std::size_t end = std::min(begin + kTileBands, bands.size());
        Tile tile{.x0 = UINT32_MAX};
        for (std::size_t band = begin; band < end; ++band) {
            if (bands[band].empty()) {
                continue;
            }
            const auto y0 = static_cast<std::uint32_t>(band) * kBandRows;
            if (tile.x1 == 0) {
                tile.y0 = y0;
            }
            tile.y1 = std::min(y0 + kBandRows, height);
            tile.x0 = std::min(tile.x0, bands[band].first);
            tile.x1 = std::max(tile.x1, bands[band].end);
        }
        if (tile.x1 > 0) {
            tiles.push_back(tile);
        }
    }
}

}  // namespace gazeloop::foveation
