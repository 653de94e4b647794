#include "runtime/foveation/band_tiles.h"

#include <algorithm>

namespace gazeloop::foveation {
namespace {

/// Narrower common parts are not worth a rectangle of their own.
constexpr std::uint32_t kLeastWidth = 4;

class Cover {
  public:
    Cover(std::span<const Columns> bands, std::uint32_t height, std::vector<Tile>& tiles)
        : bands_(bands), height_(height), tiles_(tiles) {}

    /// Covers the columns of `within` in every run of bands that has any there.
    void runs(std::size_t begin, std::size_t end, Columns within) {
        for (std::size_t band = begin; band < end;) {
            if (clipped(band, within).empty()) {
                ++band;
                continue;
            }
            const std::size_t first = band;
            while (band < end && !clipped(band, within).empty()) {
                ++band;
            }
            run(first, band, within);
        }
    }

  private:
    [[nodiscard]] Columns clipped(std::size_t band, Columns within) const {
        return {std::max(bands_[band].first, within.first), std::min(bands_[band].end, within.end)};
    }

    /// One run: what all its bands have in common, then what is left of it and right of it.
    void run(std::size_t begin, std::size_t end, Columns within) {
        Columns common = within;
        for (std::size_t band = begin; band < end; ++band) {
            common = {std::max(common.first, clipped(band, within).first),
                      std::min(common.end, clipped(band, within).end)};
        }
        const bool narrow = common.empty() || common.end - common.first < kLeastWidth;
        if (narrow && end - begin > 1) {
            const std::size_t middle = begin + (end - begin) / 2;
            run(begin, middle, within);
            run(middle, end, within);
            return;
        }
        tiles_.push_back({common.first, static_cast<std::uint32_t>(begin) * kBandRows, common.end,
                          std::min(static_cast<std::uint32_t>(end) * kBandRows, height_)});
        runs(begin, end, {within.first, common.first});
        runs(begin, end, {common.end, within.end});
    }

    std::span<const Columns> bands_;
    std::uint32_t height_;
    std::vector<Tile>& tiles_;
};

}  // namespace

void append_band_tiles(std::span<const Columns> bands, std::uint32_t height,
                       std::vector<Tile>& tiles) {
    constexpr Columns kAll{0, UINT32_MAX};
    Cover(bands, height, tiles).runs(0, bands.size(), kAll);
}

}  // namespace gazeloop::foveation
