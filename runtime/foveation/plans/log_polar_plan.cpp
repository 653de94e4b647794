#include "runtime/foveation/plans/log_polar_plan.h"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <numbers>

namespace gazeloop::foveation {
namespace {

/// Float rounding moves the shader's columns by less than this share of a texel.
constexpr double kColumnSlack = 0.01;
constexpr double kRowSlack = 0.01;

/// The columns that bilinear reads in this range touch.
Columns columns_between(LpSize lp, double from_u, double to_u) {
    const double last_column = lp.width - 1.0;
    const double low = std::floor(from_u * lp.width - 0.5 - kColumnSlack);
    const double high = std::floor(to_u * lp.width - 0.5 + kColumnSlack) + 1.0;
    return {static_cast<std::uint32_t>(std::clamp(low, 0.0, last_column)),
            static_cast<std::uint32_t>(std::clamp(high, 0.0, last_column)) + 1};
}

}  // namespace

const frame::GridList& log_polar_grids() {
    static const frame::GridList kGrids{"lp", "picture"};
    return kGrids;
}

void plan_lp_tiles(const RadialMap& map, double core_u, const HiddenArea* hidden,
                   LogPolarPlan& plan) {
    const double row_angle = 2.0 * std::numbers::pi / plan.lp.height;
    plan.texels.start(plan.lp.height);
    frame::GridCounts counts;
    counts.planned = std::uint64_t{plan.lp.width} * plan.lp.height;
    for (std::uint32_t y0 = 0; y0 < plan.lp.height; y0 += kBandRows) {
        const std::uint32_t y1 = std::min(y0 + kBandRows, plan.lp.height);
        // A row is read by pixels less than one row away from its centre.
        const double from_rad = (y0 - 0.5 - kRowSlack) * row_angle;
        const double to_rad = (y1 + 0.5 + kRowSlack) * row_angle;
        const auto on_screen = map.on_screen(from_rad, to_rad);
        Columns& band = plan.texels.bands.emplace_back();
        if (!on_screen) {
            continue;
        }
        const Columns needed = columns_between(plan.lp, on_screen->from_u, on_screen->to_u);
        const std::uint64_t rows = y1 - y0;
        if (on_screen->to_u < core_u) {
            counts.covered += rows * (needed.end - needed.first);
            continue;
        }
        band = columns_between(plan.lp, std::max(on_screen->from_u, core_u), on_screen->to_u);
        counts.covered += rows * (band.first - needed.first);
        if (hidden != nullptr) {
            const Columns whole = band;
            const auto visible = map.visible(*hidden, from_rad, to_rad);
            band = visible && visible->to_u > core_u
                       ? common(whole, columns_between(plan.lp, std::max(visible->from_u, core_u),
                                                       visible->to_u))
                       : Columns{};
            counts.hidden += rows * ((whole.end - whole.first) - (band.end - band.first));
        }
        counts.shaded += rows * (band.end - band.first);
    }
    append_band_tiles(plan.texels.bands, plan.lp.height, plan.texels.tiles);
    counts.off_screen = counts.planned - counts.shaded - counts.covered - counts.hidden;
    plan.texels.counts = counts;
}

MapUniforms map_uniforms(const LogPolarPlan& plan) {
    MapUniforms uniforms;
    if (plan.in_gaze_frame) {
        uniforms.gaze_frame = plan.in_gaze_frame->uniforms;
    } else {
        const PictureFrameUniforms in_picture =
            picture_frame_uniforms(plan.fovea, plan.log2_max_radius);
        uniforms.fovea_and_log2 = in_picture.fovea_and_log2;
        uniforms.radius_and_bands = in_picture.radius;
    }
    uniforms.radius_and_bands.z = static_cast<float>(plan.texels.bands.size());
    uniforms.lp_and_disc = glm::vec4(glm::dvec4(
        plan.lp.width, plan.lp.height,
        plan.in_gaze_frame ? plan.in_gaze_frame->disc_half_sine : plan.disc_radius_px,
        plan.in_gaze_frame ? plan.in_gaze_frame->border_half_sine : plan.disc_border_px));
    return uniforms;
}

void put_map_uniforms(const MapUniforms& uniforms, EyePlan& plan) {
    static_assert(sizeof(MapUniforms) <= sizeof plan.uniforms);
    std::memcpy(plan.uniforms.data(), &uniforms, sizeof uniforms);
}

MapUniforms map_uniforms_of(const EyePlan& plan) {
    std::array<glm::vec4, sizeof(MapUniforms) / sizeof(glm::vec4)> vectors{};
    std::copy_n(plan.uniforms.begin(), vectors.size(), vectors.begin());
    return std::bit_cast<MapUniforms>(vectors);
}

}  // namespace gazeloop::foveation
