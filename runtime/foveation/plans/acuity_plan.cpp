#include "runtime/foveation/plans/acuity_plan.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gazeloop::foveation {
namespace {

constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
constexpr double kNoCore = -1.0;
/// A wider disc leaves a flat picture: its ring is drawn no larger.
constexpr double kWidestRingDeg = 80.0;
/// Float rounding moves a pixel against the disc's edge by less than this: 4 ulp of a ray.
constexpr double kDiscSlackRad = 4.0 / (1 << 24);
/// Pixels beside the disc's edge that are shaded with it, against rounding of the row's span.
constexpr double kRowSlackPx = 0.02;

void plan_disc_tiles(const GazeFrame& frame, double eccentricity_rad, const HiddenArea* hidden,
                     SamplingPlan& plan) {
    const std::uint32_t height = frame.view().height_px;
    const double width = frame.view().width_px;
    plan.disc_bands.clear();
    for (std::uint32_t y0 = 0; y0 < height; y0 += kBandRows) {
        const std::uint32_t y1 = std::min(y0 + kBandRows, height);
        Columns& band = plan.disc_bands.emplace_back();
        for (std::uint32_t y = y0; y < y1; ++y) {
            const auto span = frame.row_within(y + 0.5, eccentricity_rad + kDiscSlackRad);
            if (!span) {
                continue;
            }
            const double first = std::ceil(span->from_x_px - kRowSlackPx - 0.5);
            const double end = std::floor(span->to_x_px + kRowSlackPx + 0.5);
            const Columns row{static_cast<std::uint32_t>(std::clamp(first, 0.0, width)),
                              static_cast<std::uint32_t>(std::clamp(end, 0.0, width))};
            if (!row.empty()) {
                band = band.empty()
                           ? row
                           : Columns{std::min(band.first, row.first), std::max(band.end, row.end)};
            }
        }
        if (hidden != nullptr) {
            band = common(band, hidden->visible_columns(y0));
        }
        if (!band.empty()) {
            plan.pixels_direct += std::uint64_t{y1 - y0} * (band.end - band.first);
        }
    }
    append_band_tiles(plan.disc_bands, height, plan.disc_tiles);
}

}  // namespace

void plan_acuity(const AcuityParameters& parameters, const AcuityProfile& profile,
                 const gaze::EyeView& view, const glm::dvec3& gaze, SamplingPlan& plan,
                 const HiddenArea* hidden) {
    const AcuityMap map(profile, GazeFrame(view, gaze));
    plan.lp = profile.lp();
    plan.fovea = {};
    plan.log2_max_radius = 0.0;
    plan.disc_radius_px = 0.0;
    plan.disc_border_px = 0.0;
    plan.disc_bands.clear();
    plan.disc_tiles.clear();
    plan.pixels_direct = 0;
    SamplingPlan::InGazeFrame in_frame{.uniforms = gaze_frame_uniforms(map.frame())};
    double core_u = kNoCore;
    if (parameters.disc) {
        const double disc_deg = std::max(map.disc_eccentricity_deg(plan.lp),
                                         std::min(profile.display_limit_deg(), 90.0));
        const double px_per_deg = pixels_per_degree(view, map.frame().nearest_in_view()).mean;
        const double border_deg = std::min(parameters.border_px / px_per_deg, 0.5 * disc_deg);
        plan.disc_radius_px = px_per_deg / kRadiansPerDegree *
                              std::tan(std::min(disc_deg, kWidestRingDeg) * kRadiansPerDegree);
        const auto half_sine = [](double deg) { return std::sin(0.5 * deg * kRadiansPerDegree); };
        in_frame.disc_half_sine = half_sine(disc_deg);
        in_frame.border_half_sine = in_frame.disc_half_sine - half_sine(disc_deg - border_deg);
        core_u = profile.u(disc_deg - border_deg);
        plan_disc_tiles(map.frame(), disc_deg * kRadiansPerDegree, hidden, plan);
    }
    plan.in_gaze_frame = in_frame;
    plan_lp_tiles(map, core_u, hidden, plan);
}

}  // namespace gazeloop::foveation
