#include "runtime/foveation/plans/shading_rings.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "runtime/foveation/eye/fovea_widening.h"
#include "runtime/foveation/picture/cone_columns.h"

namespace gazeloop::foveation {
namespace {

constexpr double kMaxEccentricityDeg = 180.0;

Expected<void> check(const RingParameters& p) {
    if (!(p.inner_deg >= 0.0 && p.inner_deg <= kMaxEccentricityDeg)) {
        return std::unexpected(
            Error{ErrorKind::Usage, fmt::format("rings.inner_deg = {}: must lie in [0, {}]",
                                                p.inner_deg, kMaxEccentricityDeg)});
    }
    if (!(p.outer_deg >= p.inner_deg && p.outer_deg <= kMaxEccentricityDeg)) {
        return std::unexpected(
            Error{ErrorKind::Usage,
                  fmt::format("rings.outer_deg = {}: must lie in [rings.inner_deg, {}] = [{}, {}]",
                              p.outer_deg, kMaxEccentricityDeg, p.inner_deg, kMaxEccentricityDeg)});
    }
    if (p.tile_px < RingParameters::kMinTilePx || p.tile_px > RingParameters::kMaxTilePx ||
        p.tile_px % 4 != 0) {
        return std::unexpected(
            Error{ErrorKind::Usage,
                  fmt::format("rings.tile_px = {}: must be a multiple of 4 in [{}, {}]", p.tile_px,
                              RingParameters::kMinTilePx, RingParameters::kMaxTilePx)});
    }
    return {};
}

std::uint32_t divided_up(std::uint32_t value, std::uint32_t divisor) {
    return (value + divisor - 1) / divisor;
}

/// The most that a pixel's centre lies from its corner, as the eye sees it.
double half_pixel_rad(const gaze::EyeView& view) {
    const glm::dvec2 scale = px_per_tangent(view);
    return 0.5 * std::hypot(1.0 / scale.x, 1.0 / scale.y);
}

/// The pixels of whole tiles that an eccentricity reaches into.
Columns tiles_within(const GazeFrame& frame, double eccentricity_deg, std::uint32_t y0,
                     std::uint32_t y1, std::uint32_t tile_px) {
    const double reach = glm::radians(eccentricity_deg) + half_pixel_rad(frame.view());
    const Columns pixels = columns_within(frame, reach, y0, y1);
    if (pixels.empty()) {
        return {};
    }
    return {pixels.first / tile_px * tile_px,
            std::min(divided_up(pixels.end, tile_px) * tile_px, frame.view().width_px)};
}

/// Cells of a rate, 2^log2_rate pixels wide, that these pixels lie in.
Columns cells(const Columns& pixels, unsigned log2_rate) {
    return {pixels.first >> log2_rate, divided_up(pixels.end, 1U << log2_rate)};
}

std::uint64_t count(const Columns& columns) { return columns.end - columns.first; }

void rate_tiles(const GazeFrame& frame, const RingParameters& parameters, RingRates& rates) {
    const gaze::EyeView& view = frame.view();
    rates.image = {view.width_px, view.height_px};
    rates.tile_px = parameters.tile_px;
    rates.samples_at = {};
    rates.rows.clear();
    rates.rows.reserve(divided_up(view.height_px, parameters.tile_px));
    for (std::uint32_t y0 = 0; y0 < view.height_px; y0 += parameters.tile_px) {
        const std::uint32_t y1 = std::min(y0 + parameters.tile_px, view.height_px);
        const auto within = [&](double eccentricity_deg) {
            return tiles_within(frame, eccentricity_deg, y0, y1, parameters.tile_px);
        };
        const RingRow row{within(parameters.inner_deg), within(parameters.outer_deg)};
        const Columns all{0, view.width_px};
        const auto cells_in = [&](const Columns& pixels, unsigned log2_rate) {
            return count(cells(pixels, log2_rate)) * divided_up(y1 - y0, 1U << log2_rate);
        };
        rates.samples_at[0] += cells_in(row.inner, 0);
        rates.samples_at[1] += cells_in(row.outer, 1) - cells_in(row.inner, 1);
        rates.samples_at[2] += cells_in(all, 2) - cells_in(row.outer, 2);
        rates.rows.push_back(row);
    }
}

}  // namespace

RingParameters sufficient_rings(const gaze::EyeView& view, const AcuityModel& model, double nasal,
                                std::uint32_t tile_px) {
    const double width_tangent = std::tan(view.fov.right_rad) - std::tan(view.fov.left_rad);
    const double height_tangent = std::tan(view.fov.up_rad) - std::tan(view.fov.down_rad);
    const double coarsest_per_deg = glm::radians(1.0) * std::min(view.width_px / width_tangent,
                                                                 view.height_px / height_tangent);
    return {.inner_deg = display_limit_deg(model, coarsest_per_deg / 2.0, nasal),
            .outer_deg = display_limit_deg(model, coarsest_per_deg / 4.0, nasal),
            .tile_px = tile_px};
}

unsigned RingRates::log2_rate(std::uint32_t x_px, std::uint32_t y_px) const {
    const RingRow& row = rows[y_px / tile_px];
    const auto in = [&](const Columns& columns) {
        return x_px >= columns.first && x_px < columns.end;
    };
    return in(row.inner) ? 0U : in(row.outer) ? 1U : 2U;
}

Expected<RingRates> plan_rings(const GazeField& field, const RingParameters& parameters) {
    if (const auto checked = check(parameters); !checked) {
        return std::unexpected(checked.error());
    }
    RingRates rates;
    rate_tiles(field.frame(), parameters, rates);
    return rates;
}

SampleGrid RingDensity::at(const FieldPoint& at) const {
    const auto pixel = [](double position_px, std::uint32_t count) {
        return static_cast<std::uint32_t>(std::clamp(std::floor(position_px), 0.0, count - 1.0));
    };
    const unsigned log2_rate = rates_.log2_rate(pixel(at.pixel.x_px, rates_.image.width_px),
                                                pixel(at.pixel.y_px, rates_.image.height_px));
    return SampleGrid::square(1.0 / (1U << log2_rate)).in_degrees(at);
}

const frame::GridList& RingsPlan::grids() const {
    static const frame::GridList kGrids{"rate_1", "rate_2", "rate_4"};
    return kGrids;
}

std::size_t RingsPlan::table_words(std::uint32_t height_px) {
    return std::size_t{6} * divided_up(height_px, kBandRows);
}

bool RingsPlan::fits(const gaze::StereoView& views) const { return prepared_.fit(views); }

Expected<void> RingsPlan::prepare(const gaze::StereoView& views) {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        const auto rings = rings_of_(views[e]);
        if (!rings) {
            return std::unexpected(rings.error());
        }
        if (auto checked = check(*rings); !checked) {
            return checked;
        }
        rings_[e] = *rings;
    }
    prepared_.take(views);
    return {};
}

void RingsPlan::plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
                     const HiddenArea* hidden, const FrameInRun& /*frame*/, EyePlan& plan) const {
    constexpr unsigned kRates = 3;
    const RingParameters& rings = rings_[gaze::index(eye)];
    const GazeFrame frame(view, fovea.direction);
    plan.grids.resize(kRates);
    for (unsigned rate = 0; rate < kRates; ++rate) {
        plan.grids[rate].start(divided_up(view.height_px, 1U << rate));
    }
    plan.table.clear();
    plan.table.reserve(table_words(view.height_px));
    RingRow row;
    for (std::uint32_t y0 = 0; y0 < view.height_px; y0 += kBandRows) {
        const std::uint32_t y1 = std::min(y0 + kBandRows, view.height_px);
        if (y0 % rings.tile_px == 0) {
            const std::uint32_t end = std::min(y0 + rings.tile_px, view.height_px);
            row = {tiles_within(frame, rings.inner_deg, y0, end, rings.tile_px),
                   tiles_within(frame, rings.outer_deg, y0, end, rings.tile_px)};
        }
        const Columns all{0, view.width_px};
        const Columns visible = hidden != nullptr ? hidden->visible_columns(y0) : all;
        const std::array shown{common(row.inner, visible), common(row.outer, visible), visible};
        for (const Columns& columns : shown) {
            plan.table.push_back(columns.first);
            plan.table.push_back(columns.end);
        }
        for (unsigned rate = 0; rate < kRates; ++rate) {
            const Columns cut = cells(shown.at(rate), rate);
            const std::uint64_t rows = divided_up(y1 - y0, 1U << rate);
            const std::uint64_t finer = rate > 0 ? count(cells(shown.at(rate - 1), rate)) : 0;
            frame::GridCounts counts;
            counts.planned = rows * count(cells(all, rate));
            counts.shaded = rows * (count(cut) - finer);
            counts.hidden = rows * (count(cells(all, rate)) - count(cells(visible, rate)));
            counts.covered = counts.planned - counts.shaded - counts.hidden;
            ShadedGrid& grid = plan.grids[rate];
            grid.counts += counts;
            if ((y0 >> rate) % kBandRows == 0) {
                grid.bands.emplace_back();
            }
            if (counts.shaded > 0) {
                Columns& band = grid.bands.back();
                band = band.empty()
                           ? cut
                           : Columns{std::min(band.first, cut.first), std::max(band.end, cut.end)};
            }
        }
    }
    for (unsigned rate = 0; rate < kRates; ++rate) {
        ShadedGrid& grid = plan.grids[rate];
        append_band_tiles(grid.bands, divided_up(view.height_px, 1U << rate), grid.tiles);
    }
}

}  // namespace gazeloop::foveation
