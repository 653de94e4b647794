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

/// The columns of the pixels of rows [y0, y1) within an eccentricity, and of all between them.
Columns disc_band(const GazeFrame& frame, double eccentricity_rad, std::uint32_t y0,
                  std::uint32_t y1) {
    const double width = frame.view().width_px;
    Columns band{};
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
    return band;
}

}  // namespace

void plan_acuity(const AcuityParameters& parameters, const AcuityProfile& profile,
                 const gaze::EyeView& view, const glm::dvec3& gaze, LogPolarPlan& plan,
                 const HiddenArea* hidden, double widening_deg) {
    const AcuityMap map(profile, GazeFrame(view, gaze));
    plan.lp = profile.lp();
    plan.fovea = {};
    plan.log2_max_radius = 0.0;
    plan.disc_radius_px = 0.0;
    plan.disc_border_px = 0.0;
    plan.disc.start(view.height_px);
    LogPolarPlan::InGazeFrame in_frame{.uniforms = gaze_frame_uniforms(map.frame())};
    double core_u = kNoCore;
    if (parameters.disc) {
        const double disc_deg =
            std::max(map.disc_eccentricity_deg(plan.lp),
                     std::min(profile.display_limit_deg() + widening_deg, 90.0));
        const double px_per_deg = pixels_per_degree(view, map.frame().nearest_in_view()).mean;
        const double border_deg = std::min(parameters.border_px / px_per_deg, 0.5 * disc_deg);
        plan.disc_radius_px = px_per_deg / kRadiansPerDegree *
                              std::tan(std::min(disc_deg, kWidestRingDeg) * kRadiansPerDegree);
        const auto half_sine = [](double deg) { return std::sin(0.5 * deg * kRadiansPerDegree); };
        in_frame.disc_half_sine = half_sine(disc_deg);
        in_frame.border_half_sine = in_frame.disc_half_sine - half_sine(disc_deg - border_deg);
        core_u = profile.u(disc_deg - border_deg);
        plan_disc_tiles(
            view.height_px, hidden,
            [&](std::uint32_t y0, std::uint32_t y1) {
                return disc_band(map.frame(), disc_deg * kRadiansPerDegree, y0, y1);
            },
            plan.disc);
    }
    plan.in_gaze_frame = in_frame;
    plan_lp_tiles(map, core_u, hidden, plan);
}

bool AcuityPlan::fits(const gaze::StereoView& views) const {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        if (!profiles_[e] || fov_[e] != views[e].fov || images_[e].width_px != views[e].width_px ||
            images_[e].height_px != views[e].height_px) {
            return false;
        }
    }
    return true;
}

Expected<void> AcuityPlan::prepare(const gaze::StereoView& views) {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        auto profile = AcuityProfile::create(parameters_, views[e]);
        if (!profile) {
            return std::unexpected(profile.error());
        }
        profiles_[e] = *std::move(profile);
        fov_[e] = views[e].fov;
        images_[e] = {views[e].width_px, views[e].height_px};
    }
    return {};
}

void AcuityPlan::plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
                      const HiddenArea* hidden, EyePlan& plan) const {
    plan_log_polar(plan, [&](LogPolarPlan& made) {
        plan_acuity(parameters_, *profiles_[gaze::index(eye)], view, fovea.direction, made, hidden,
                    fovea.uncertainty_rad.value_or(0.0) / kRadiansPerDegree);
    });
}

}  // namespace gazeloop::foveation
