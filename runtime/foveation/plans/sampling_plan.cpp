#include "runtime/foveation/plans/sampling_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gazeloop::foveation {
namespace {

/// Float rounding moves the shader's columns by less than this share of a texel.
constexpr double kColumnSlack = 0.01;
constexpr double kRowSlack = 0.01;
/// ... and its distance from the fovea by less than this.
constexpr double kDiscSlackPx = 0.02;
constexpr double kNoCore = -1.0;

/// The columns that bilinear reads in this range touch.
Columns columns_between(LpSize lp, double from_u, double to_u) {
    const double last_column = lp.width - 1.0;
    const double low = std::floor(from_u * lp.width - 0.5 - kColumnSlack);
    const double high = std::floor(to_u * lp.width - 0.5 + kColumnSlack) + 1.0;
    return {static_cast<std::uint32_t>(std::clamp(low, 0.0, last_column)),
            static_cast<std::uint32_t>(std::clamp(high, 0.0, last_column)) + 1};
}

}  // namespace

void plan_lp_tiles(const RadialMap& map, double core_u, const HiddenArea* hidden,
                   SamplingPlan& plan) {
    const double row_angle = 2.0 * std::numbers::pi / plan.lp.height;
    plan.lp_bands.clear();
    plan.lp_tiles.clear();
    plan.texels_shaded = 0;
    plan.texels_under_disc = 0;
    plan.texels_hidden = 0;
    for (std::uint32_t y0 = 0; y0 < plan.lp.height; y0 += kBandRows) {
        const std::uint32_t y1 = std::min(y0 + kBandRows, plan.lp.height);
        // A row is read by pixels less than one row away from its centre.
        const double from_rad = (y0 - 0.5 - kRowSlack) * row_angle;
        const double to_rad = (y1 + 0.5 + kRowSlack) * row_angle;
        const auto on_screen = map.on_screen(from_rad, to_rad);
        Columns& band = plan.lp_bands.emplace_back();
        if (!on_screen) {
            continue;
        }
        const Columns needed = columns_between(plan.lp, on_screen->from_u, on_screen->to_u);
        const std::uint64_t rows = y1 - y0;
        if (on_screen->to_u < core_u) {
            plan.texels_under_disc += rows * (needed.end - needed.first);
            continue;
        }
        band = columns_between(plan.lp, std::max(on_screen->from_u, core_u), on_screen->to_u);
        plan.texels_under_disc += rows * (band.first - needed.first);
        if (hidden != nullptr) {
            const Columns whole = band;
            const auto visible = map.visible(*hidden, from_rad, to_rad);
            band = visible && visible->to_u > core_u
                       ? common(whole, columns_between(plan.lp, std::max(visible->from_u, core_u),
                                                       visible->to_u))
                       : Columns{};
            plan.texels_hidden += rows * ((whole.end - whole.first) - (band.end - band.first));
        }
        plan.texels_shaded += rows * (band.end - band.first);
    }
    append_band_tiles(plan.lp_bands, plan.lp.height, plan.lp_tiles);
    plan.texels_off_screen = std::uint64_t{plan.lp.width} * plan.lp.height - plan.texels_shaded -
                             plan.texels_under_disc - plan.texels_hidden;
}

namespace {

void plan_disc_tiles(ImageSize image, const HiddenArea* hidden, SamplingPlan& plan) {
    const double radius = plan.disc_radius_px + kDiscSlackPx;
    const double width = image.width_px;
    plan.disc_bands.clear();
    for (std::uint32_t y0 = 0; y0 < image.height_px; y0 += kBandRows) {
        const std::uint32_t y1 = std::min(y0 + kBandRows, image.height_px);
        const double nearest_y = std::clamp(plan.fovea.y_px, y0 + 0.5, y1 - 0.5);
        const double dy = nearest_y - plan.fovea.y_px;
        Columns& band = plan.disc_bands.emplace_back();
        if (std::abs(dy) >= radius) {
            continue;
        }
        const double reach = std::sqrt(radius * radius - dy * dy);
        // Pixels whose centres lie within reach.
        band = {static_cast<std::uint32_t>(
                    std::clamp(std::ceil(plan.fovea.x_px - reach - 0.5), 0.0, width)),
                static_cast<std::uint32_t>(
                    std::clamp(std::floor(plan.fovea.x_px + reach + 0.5), 0.0, width))};
        if (hidden != nullptr) {
            band = common(band, hidden->visible_columns(y0));
        }
        if (!band.empty()) {
            plan.pixels_direct += std::uint64_t{y1 - y0} * (band.end - band.first);
        }
    }
    append_band_tiles(plan.disc_bands, image.height_px, plan.disc_tiles);
}

}  // namespace

void plan_kfr(const KfrParameters& parameters, LpSize lp, ImageSize image,
              const gaze::PixelPosition& fovea, SamplingPlan& plan, const HiddenArea* hidden) {
    const LogPolarMap map(parameters.kernel, image, fovea);
    plan.lp = lp;
    plan.fovea = fovea;
    plan.log2_max_radius = map.log2_max_radius();
    plan.disc_bands.clear();
    plan.in_gaze_frame.reset();
    plan.disc_radius_px = 0.0;
    plan.disc_border_px = 0.0;
    if (parameters.disc) {
        plan.disc_radius_px = map.disc_radius_px(lp);
        plan.disc_border_px = std::min(parameters.border_px, 0.5 * plan.disc_radius_px);
    } else if (parameters.close_hole) {
        // Around the hole, so that no part of the hole shows through the blend.
        const double hole_px = map.hole_radius_px(lp);
        plan.disc_border_px = std::min(parameters.border_px, hole_px);
        plan.disc_radius_px = hole_px + plan.disc_border_px;
    }
    plan.disc_tiles.clear();
    plan.pixels_direct = 0;
    if (plan.disc_radius_px >= map.max_radius_px()) {
        plan.disc_border_px = 0.0;  // the disc covers the screen: there is nothing to blend with
    }
    plan_lp_tiles(
        map, plan.disc_radius_px > 0.0 ? map.u(plan.disc_radius_px - plan.disc_border_px) : kNoCore,
        hidden, plan);
    if (plan.disc_radius_px > 0.0) {
        plan_disc_tiles(image, hidden, plan);
    }
}

}  // namespace gazeloop::foveation
