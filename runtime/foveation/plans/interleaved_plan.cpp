#include "runtime/foveation/plans/interleaved_plan.h"

#include <algorithm>

namespace gazeloop::foveation {
namespace {

/// Appends the bands of a grid of so many rows; bands that it lacks are empty.
void append_bands(const ShadedGrid& grid, std::uint32_t rows, std::vector<std::uint32_t>& table) {
    const std::uint32_t bands = InterleavedPlan::bands(rows);
    for (std::size_t band = 0; band < bands; ++band) {
        const Columns columns = band < grid.bands.size() ? grid.bands[band] : Columns{};
        table.push_back(columns.first);
        table.push_back(columns.end);
    }
}

/// Turns a grid of texels into that of the blocks that hold any of them.
void take_turns(CellTurns turns, std::uint32_t height, ShadedGrid& grid) {
    if (turns.every == 1) {
        return;
    }
    const std::size_t texel_bands = grid.bands.size();
    const std::size_t merged = turns.block_height();
    const std::uint32_t rows = turns.rows(height);
    std::size_t bands = 0;
    std::uint64_t shaded = 0;
    for (std::size_t first = 0; first < texel_bands; first += merged, ++bands) {
        Columns all;
        for (std::size_t i = first; i < std::min(first + merged, texel_bands); ++i) {
            const Columns one = grid.bands[i];
            if (!one.empty()) {
                all = all.empty()
                          ? one
                          : Columns{std::min(all.first, one.first), std::max(all.end, one.end)};
            }
        }
        const Columns cells{all.first / turns.block_width(), turns.columns(all.end)};
        grid.bands[bands] = all.empty() ? Columns{} : cells;
        const auto y0 = static_cast<std::uint32_t>(bands * kBandRows);
        shaded += std::uint64_t{std::min(y0 + kBandRows, rows) - y0} *
                  (grid.bands[bands].end - grid.bands[bands].first);
    }
    grid.bands.resize(bands);
    grid.tiles.clear();
    append_band_tiles(grid.bands, rows, grid.tiles);
    frame::GridCounts& counts = grid.counts;
    counts.shaded = shaded;
    counts.off_screen /= turns.every;
    counts.covered /= turns.every;
    counts.hidden /= turns.every;
    counts.planned = counts.shaded + counts.off_screen + counts.covered + counts.hidden;
}

}  // namespace

void InterleavedPlan::plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
                           const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const {
    whole_->plan(eye, view, fovea, hidden, frame, plan);
    const std::uint32_t texel_rows = whole_->lp(eye).height;
    plan.table.clear();
    plan.table.reserve(std::size_t{2} * (bands(texel_rows) + bands(view.height_px)));
    append_bands(plan.grids[0], texel_rows, plan.table);
    append_bands(plan.grids[1], view.height_px, plan.table);
    take_turns(texels_, texel_rows, plan.grids[0]);
    take_turns(pixels_, view.height_px, plan.grids[1]);
}

}  // namespace gazeloop::foveation
