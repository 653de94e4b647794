#include "runtime/foveation/plans/sparse_plan.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace gazeloop::foveation {
namespace {

/// A range of columns, half open, that may reach beyond the picture.
struct Range {
    int first = 0;
    int end = 0;
};

/// Where a picture lies in its pattern, which may be mirrored: pixel p at origin + sign * p.
struct Axis {
    int origin = 0;
    int sign = 1;
    int size = 0;  ///< of the pattern

    [[nodiscard]] int in_pattern(int pixel) const { return origin + sign * pixel; }
    [[nodiscard]] int in_picture(int place) const { return sign * (place - origin); }
    [[nodiscard]] Range in_pattern(const Range& pixels) const {
        const int a = in_pattern(pixels.first);
        const int b = in_pattern(pixels.end - 1);
        return {std::max(std::min(a, b), 0), std::min(std::max(a, b) + 1, size)};
    }
};

Axis axis(std::uint32_t window, std::uint32_t field, bool mirrored) {
    const auto first = static_cast<int>(window);
    const auto size = static_cast<int>(field);
    return mirrored ? Axis{size - 1 - first, -1, size} : Axis{first, 1, size};
}

/// One eye's samples at one gaze.
class ListMaker {
  public:
    ListMaker(const SparsePlan::Prepared& prepared, const Axis& across, const Axis& down,
              std::span<const Tile> shown)
        : prepared_(prepared), across_(across), down_(down), shown_(shown) {
        reach_ = reach();
    }

    /// Rows of the pattern that some sample may lie in.
    [[nodiscard]] Range rows() const {
        return down_.in_pattern(Range{static_cast<int>(shown_.front().y0) - reach_,
                                      static_cast<int>(shown_.back().y1) + reach_});
    }

    /// Indices of the samples of a row of the pattern; none: an empty range.
    [[nodiscard]] std::pair<std::uint32_t, std::uint32_t> samples_in_row(int row) const {
        const int y = down_.in_picture(row);
        std::optional<Range> pixels;
        for (const Tile& tile : shown_) {
            if (static_cast<int>(tile.y0) > y + reach_ || static_cast<int>(tile.y1) <= y - reach_) {
                continue;
            }
            const Range wide{static_cast<int>(tile.x0) - reach_,
                             static_cast<int>(tile.x1) + reach_};
            pixels =
                pixels ? Range{std::min(pixels->first, wide.first), std::max(pixels->end, wide.end)}
                       : wide;
        }
        const auto begin = prepared_.pattern.samples.begin();
        const auto first = begin + prepared_.row_first[static_cast<std::size_t>(row)];
        const auto last = begin + prepared_.row_first[static_cast<std::size_t>(row) + 1];
        const Range columns = pixels ? across_.in_pattern(*pixels) : Range{};
        const auto at = [&](int column) {
            return static_cast<std::uint32_t>(
                std::ranges::lower_bound(first, last, column, {}, &FieldPixel::x) - begin);
        };
        return {at(columns.first), at(std::max(columns.first, columns.end))};
    }

  private:
    /// How far from what is shown a sample may lie that a shown pixel is filled from. The way to it
    /// leaves a tile at its edge. From there it is no farther than the neighbours of a pixel there,
    /// and distances to neighbours differ by less than pixels do.
    [[nodiscard]] int reach() const {
        int most = 0;
        const auto look = [&](std::uint32_t x, std::uint32_t y) {
            const auto place = static_cast<std::size_t>(down_.in_pattern(static_cast<int>(y))) *
                                   static_cast<std::size_t>(across_.size) +
                               static_cast<std::size_t>(across_.in_pattern(static_cast<int>(x)));
            most = std::max(most, int{prepared_.reach_px[place]});
        };
        for (const Tile& tile : shown_) {
            for (std::uint32_t x = tile.x0; x < tile.x1; ++x) {
                look(x, tile.y0);
                look(x, tile.y1 - 1);
            }
            for (std::uint32_t y = tile.y0; y < tile.y1; ++y) {
                look(tile.x0, y);
                look(tile.x1 - 1, y);
            }
        }
        return most + 2;
    }

    const SparsePlan::Prepared& prepared_;
    const Axis& across_;
    const Axis& down_;
    std::span<const Tile> shown_;
    int reach_ = 0;
};

Expected<std::shared_ptr<const SparsePlan::Prepared>> prepare_size(const SparseOptions& options,
                                                                   ImageSize image) {
    auto pattern = make_sparse_pattern(options.pattern, image);
    if (!pattern) {
        return std::unexpected(pattern.error());
    }
    auto nearest = find_nearest_samples(*pattern, options.neighbours);
    if (!nearest) {
        return std::unexpected(nearest.error());
    }
    auto made = std::make_shared<SparsePlan::Prepared>();
    made->pattern = *std::move(pattern);
    made->nearest = *std::move(nearest);
    const ImageSize field = made->pattern.field();
    const std::vector<FieldPixel>& samples = made->pattern.samples;
    made->row_first.reserve(field.height_px + 1);
    for (std::uint32_t y = 0; y <= field.height_px; ++y) {
        made->row_first.push_back(static_cast<std::uint32_t>(
            std::ranges::lower_bound(samples, y, {}, &FieldPixel::y) - samples.begin()));
    }
    made->reach_px.reserve(std::size_t{field.width_px} * field.height_px);
    for (std::uint32_t y = 0; y < field.height_px; ++y) {
        for (std::uint32_t x = 0; x < field.width_px; ++x) {
            const FieldPixel& farthest = samples[made->nearest.of(x, y).back()];
            const double distance =
                std::hypot(farthest.x - static_cast<int>(x), farthest.y - static_cast<int>(y));
            made->reach_px.push_back(static_cast<std::uint16_t>(std::ceil(distance)));
        }
    }
    return made;
}

}  // namespace

const frame::GridList& SparsePlan::grids() const {
    static const frame::GridList kGrids{"samples"};
    return kGrids;
}

bool SparsePlan::fits(const gaze::StereoView& views) const { return views_.fit(views); }

Expected<void> SparsePlan::prepare(const gaze::StereoView& views) {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        const ImageSize image{views[e].width_px, views[e].height_px};
        const auto same = std::ranges::find_if(prepared_, [&](const auto& made) {
            return made != nullptr && made->pattern.image.width_px == image.width_px &&
                   made->pattern.image.height_px == image.height_px;
        });
        if (same != prepared_.end()) {
            prepared_[e] = *same;
            continue;
        }
        auto made = prepare_size(options_, image);
        if (!made) {
            return std::unexpected(made.error());
        }
        prepared_[e] = *std::move(made);
    }
    views_.take(views);
    return {};
}

void SparsePlan::plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
                      const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const {
    const Prepared& prepared = *prepared_[gaze::index(eye)];
    const FieldPixel window = prepared.pattern.window(fovea.position);
    const ImageSize field = prepared.pattern.field();
    // As it is, half a turn, mirrored to the side, mirrored upside down.
    const std::uint64_t turn = options_.turn ? frame.index % 4 : 0;
    const Axis across = axis(window.x, field.width_px, turn == 1 || turn == 2);
    const Axis down = axis(window.y, field.height_px, turn == 1 || turn == 3);
    const Tile whole{0, 0, view.width_px, view.height_px};
    const ListMaker all(prepared, across, down, {&whole, 1});
    const ListMaker seen(prepared, across, down,
                         hidden != nullptr ? hidden->visible_tiles() : std::span(&whole, 1));
    plan.grids.resize(1);
    ShadedGrid& grid = plan.grids[0];
    grid.start(prepared.list_rows());
    plan.table.clear();
    plan.table.reserve(prepared.table_words());
    plan.table.resize(kHeader);
    const Range rows = seen.rows();
    std::uint32_t count = 0;
    std::uint64_t in_all = 0;
    for (int row = rows.first; row < rows.end; ++row) {
        const auto [first, end] = seen.samples_in_row(row);
        plan.table.push_back(count);
        plan.table.push_back(first);
        count += end - first;
    }
    plan.table.push_back(count);
    plan.table.push_back(0);
    if (hidden != nullptr) {
        const Range all_rows = all.rows();
        for (int row = all_rows.first; row < all_rows.end; ++row) {
            const auto [first, end] = all.samples_in_row(row);
            in_all += end - first;
        }
    }
    const auto word = [&](std::size_t at, int value) {
        plan.table[at] = static_cast<std::uint32_t>(value);
    };
    plan.table[0] = count;
    word(1, rows.end - rows.first);
    word(2, rows.first);
    word(3, across.origin);
    word(4, down.origin);
    word(5, across.sign);
    word(6, down.sign);
    grid.counts.planned = prepared.pattern.samples.size();
    grid.counts.shaded = count;
    grid.counts.hidden = in_all > count ? in_all - count : 0;
    grid.counts.off_screen = grid.counts.planned - count - grid.counts.hidden;
    for (std::uint32_t row = 0; row < prepared.list_rows(); row += kBandRows) {
        const bool used = std::uint64_t{row} * kListWidth < count;
        grid.bands.push_back(used ? Columns{0, kListWidth} : Columns{});
    }
    append_band_tiles(grid.bands, prepared.list_rows(), grid.tiles);
}

}  // namespace gazeloop::foveation
