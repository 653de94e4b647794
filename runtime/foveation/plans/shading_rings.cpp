#include "runtime/foveation/plans/shading_rings.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "runtime/foveation/eye/fovea_widening.h"

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

Expected<RingPlan> plan_rings(const GazeField& field, const RingParameters& parameters) {
    if (const auto checked = check(parameters); !checked) {
        return std::unexpected(checked.error());
    }
    const std::uint32_t width = field.view().width_px;
    const std::uint32_t height = field.view().height_px;
    const std::uint32_t tile = parameters.tile_px;
    RingPlan plan{.tile_px = tile,
                  .columns = divided_up(width, tile),
                  .rows = divided_up(height, tile),
                  .log2_rate = {}};
    plan.log2_rate.reserve(std::size_t{plan.columns} * plan.rows);
    for (std::uint32_t row = 0; row < plan.rows; ++row) {
        const std::uint32_t y0 = row * tile;
        const std::uint32_t y1 = std::min(y0 + tile, height);
        for (std::uint32_t column = 0; column < plan.columns; ++column) {
            const std::uint32_t x0 = column * tile;
            const std::uint32_t x1 = std::min(x0 + tile, width);
            const double nearest_deg =
                field.least_eccentricity_deg({static_cast<double>(x0), static_cast<double>(y0)},
                                             {static_cast<double>(x1), static_cast<double>(y1)});
            const unsigned log2_rate = nearest_deg <= parameters.inner_deg   ? 0U
                                       : nearest_deg <= parameters.outer_deg ? 1U
                                                                             : 2U;
            plan.log2_rate.push_back(static_cast<std::uint8_t>(log2_rate));
            plan.samples_at[log2_rate] += std::uint64_t{divided_up(x1 - x0, 1U << log2_rate)} *
                                          divided_up(y1 - y0, 1U << log2_rate);
        }
    }
    return plan;
}

SampleGrid RingDensity::at(const FieldPoint& at) const {
    const auto tile = [&](double position_px, std::uint32_t count) {
        const double index = std::floor(position_px / plan_.tile_px);
        return static_cast<std::size_t>(std::clamp(index, 0.0, count - 1.0));
    };
    const unsigned log2_rate = plan_.log2_rate[tile(at.pixel.y_px, plan_.rows) * plan_.columns +
                                               tile(at.pixel.x_px, plan_.columns)];
    return SampleGrid::square(1.0 / (1U << log2_rate)).in_degrees(at);
}

}  // namespace gazeloop::foveation
