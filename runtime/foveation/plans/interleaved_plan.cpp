#include "runtime/foveation/plans/interleaved_plan.h"

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <optional>

namespace gazeloop::foveation {
namespace {

/// As far as this the gaze may move from frame to frame, and what is kept serves as it is.
constexpr double kLeastJump_px = 2.0;
/// What is kept of texels within so many jumps around the fovea is of little use: it was seen with
/// texels of twice the size.
constexpr double kCoarserWithinJumps = 1.0;
/// At the disc's border it is blended with texels, so that it can be smaller by this unseen.
constexpr double kBorderSlack_px = 1.0;

/// Appends the bands of a grid of so many rows; bands that it lacks are empty.
void append_bands(const ShadedGrid& grid, std::uint32_t rows, std::vector<std::uint32_t>& table) {
    const std::uint32_t bands = InterleavedPlan::bands(rows);
    for (std::size_t band = 0; band < bands; ++band) {
        const Columns columns = band < grid.bands.size() ? grid.bands[band] : Columns{};
        table.push_back(columns.first);
        table.push_back(columns.end);
    }
}

/// The cells of the blocks that hold any of a band's texels. `of_texels(i)`: what band i of the
/// texels needs.
template <typename OfTexels>
Columns band_of_cells(CellTurns turns, std::size_t band, std::size_t texel_bands,
                      const OfTexels& of_texels) {
    const std::size_t merged = turns.block_height();
    Columns all;
    for (std::size_t i = band * merged; i < std::min((band + 1) * merged, texel_bands); ++i) {
        const Columns one = of_texels(i);
        if (!one.empty()) {
            all = all.empty() ? one
                              : Columns{std::min(all.first, one.first), std::max(all.end, one.end)};
        }
    }
    return all.empty() ? Columns{}
                       : Columns{all.first / turns.block_width(), turns.columns(all.end)};
}

/// Cells of a band of a grid with so many rows of them.
std::uint64_t cells_of(const Columns& columns, std::size_t band, std::uint32_t rows) {
    const auto y0 = static_cast<std::uint32_t>(band * kBandRows);
    return columns.empty()
               ? 0
               : std::uint64_t{std::min(y0 + kBandRows, rows) - y0} * (columns.end - columns.first);
}

/// Turns a grid of texels into that of the blocks that hold any of them. Appends the bands of those
/// that are shaded whole: `refill(i, columns)` says which of band i's texels.
template <typename Refill>
void take_turns(CellTurns turns, std::uint32_t height, const Refill& refill, ShadedGrid& grid,
                std::vector<std::uint32_t>& table) {
    const std::size_t texel_bands = grid.bands.size();
    const std::uint32_t rows = turns.rows(height);
    const std::size_t all_bands = InterleavedPlan::bands(rows);
    std::uint64_t refilled = 0;
    for (std::size_t band = 0; band < all_bands; ++band) {
        const Columns cells = band_of_cells(turns, band, texel_bands, [&](std::size_t i) {
            return grid.bands[i].empty() ? Columns{} : refill(i, grid.bands[i]);
        });
        table.push_back(cells.first);
        table.push_back(cells.end);
        refilled += cells_of(cells, band, rows) * (turns.every - 1);
    }
    if (turns.every == 1) {
        return;
    }
    std::uint64_t shaded = 0;
    std::size_t bands = 0;
    for (; bands * turns.block_height() < texel_bands; ++bands) {
        // Those of the texels lie further on, or here.
        grid.bands[bands] =
            band_of_cells(turns, bands, texel_bands, [&](std::size_t i) { return grid.bands[i]; });
        shaded += cells_of(grid.bands[bands], bands, rows);
    }
    grid.bands.resize(bands);
    grid.tiles.clear();
    append_band_tiles(grid.bands, rows, grid.tiles);
    frame::GridCounts& counts = grid.counts;
    counts.shaded = shaded + refilled;
    counts.off_screen /= turns.every;
    counts.covered /= turns.every;
    counts.hidden /= turns.every;
    counts.planned = counts.shaded + counts.off_screen + counts.covered + counts.hidden;
}

/// Where the last fovea is seen by a view, far away.
gaze::PixelPosition seen_by(const gaze::EyeView& view, const EyeBefore& before) {
    const glm::dvec3 direction = gaze::unproject(before.fovea, before.view);
    const glm::dvec3 in_world = before.view.pose.orientation * direction;
    return gaze::project(glm::inverse(view.pose.orientation) * in_world, view);
}

/// The columns of a circle's pixels that every row of [y0, y1) has.
Columns columns_of_circle(const gaze::PixelPosition& centre, double radius, double y0, double y1,
                          double width) {
    const double dy = std::max(std::abs(y0 + 0.5 - centre.y_px), std::abs(y1 - 0.5 - centre.y_px));
    if (dy >= radius) {
        return {};
    }
    const double reach = std::sqrt(radius * radius - dy * dy);
    return {
        static_cast<std::uint32_t>(std::clamp(std::ceil(centre.x_px - reach - 0.5), 0.0, width)),
        static_cast<std::uint32_t>(std::clamp(std::floor(centre.x_px + reach + 0.5), 0.0, width))};
}

/// What of `columns` does not lie in others, and what lies between.
Columns without(const Columns& columns, const Columns& others) {
    const bool at_first = others.first <= columns.first;
    const bool at_end = others.end >= columns.end;
    if (common(columns, others).empty() || !(at_first || at_end)) {
        return columns;
    }
    return at_first && at_end ? Columns{}
           : at_first         ? Columns{others.end, columns.end}
                              : Columns{columns.first, others.first};
}

}  // namespace

void InterleavedPlan::plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
                           const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const {
    whole_->plan(eye, view, fovea, hidden, frame, plan);
    const LpSize lp = whole_->lp(eye);
    plan.table.clear();
    plan.table.reserve(std::size_t{2} *
                       (bands(lp.height) + bands(view.height_px) + bands(texels_.rows(lp.height)) +
                        bands(pixels_.rows(view.height_px))));
    append_bands(plan.grids[0], lp.height, plan.table);
    append_bands(plan.grids[1], view.height_px, plan.table);
    const std::optional<EyeBefore>& before = frame.before[gaze::index(eye)];
    const gaze::PixelPosition was = before ? seen_by(view, *before) : fovea.position;
    const double jump_px =
        std::hypot(fovea.position.x_px - was.x_px, fovea.position.y_px - was.y_px);
    const bool jumps = jump_px >= kLeastJump_px;
    const auto coarse_columns = static_cast<std::uint32_t>(
        std::ceil(lp.width *
                  (jumps ? whole_->column_share(eye, fovea, kCoarserWithinJumps * jump_px) : 0.0)));
    const auto refill_texels = [&](std::size_t /*band*/, const Columns& columns) {
        return !refills_ ? Columns{} : !before ? columns : common(columns, {0, coarse_columns});
    };
    const auto refill_pixels = [&](std::size_t band, const Columns& columns) {
        if (!refills_ || (before && !jumps)) {
            return Columns{};
        }
        const std::size_t y0 = band * kBandRows;
        const auto y1 = std::min<std::size_t>(y0 + kBandRows, view.height_px);
        return !before
                   ? columns
                   : without(columns, columns_of_circle(was, plan.ring_px - kBorderSlack_px,
                                                        static_cast<double>(y0),
                                                        static_cast<double>(y1), view.width_px));
    };
    take_turns(texels_, lp.height, refill_texels, plan.grids[0], plan.table);
    take_turns(pixels_, view.height_px, refill_pixels, plan.grids[1], plan.table);
}

InterleavedPlan::Bands InterleavedPlan::bands_of(const EyePlan& plan, gaze::Eye eye,
                                                 std::uint32_t rows) const {
    std::span<const std::uint32_t> rest = plan.table;
    const auto next = [&](std::uint32_t of_rows) {
        const auto words = rest.first(2 * std::size_t{bands(of_rows)});
        rest = rest.subspan(words.size());
        return words;
    };
    const std::uint32_t texel_rows = whole_->lp(eye).height;
    Bands found;
    found.texels = next(texel_rows);
    found.pixels = next(rows);
    found.texel_refill = next(texels_.rows(texel_rows));
    found.pixel_refill = next(pixels_.rows(rows));
    return found;
}

}  // namespace gazeloop::foveation
