#include "runtime/foveation/plans/acuity_plan.h"

#include <algorithm>
#include <cmath>

#include "runtime/foveation/picture/angles.h"
#include "runtime/foveation/picture/cone_columns.h"

namespace gazeloop::foveation {
namespace {

/// A wider disc leaves a flat picture: its ring is drawn no larger.
constexpr double kWidestRingDeg = 80.0;

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
                return columns_within(map.frame(), disc_deg * kRadiansPerDegree, y0, y1);
            },
            plan.disc);
    }
    plan.in_gaze_frame = in_frame;
    plan_lp_tiles(map, core_u, hidden, plan);
}

bool AcuityPlan::fits(const gaze::StereoView& views) const { return prepared_.fit(views); }

Expected<void> AcuityPlan::prepare(const gaze::StereoView& views) {
    for (std::size_t e = 0; e < gaze::kEyeCount; ++e) {
        auto profile = AcuityProfile::create(parameters_, views[e]);
        if (!profile) {
            return std::unexpected(profile.error());
        }
        profiles_[e] = *std::move(profile);
    }
    prepared_.take(views);
    return {};
}

void AcuityPlan::plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
                      const HiddenArea* hidden, const FrameInRun& /*frame*/, EyePlan& plan) const {
    plan_log_polar(plan, [&](LogPolarPlan& made) {
        plan_acuity(parameters_, *profiles_[gaze::index(eye)], view, fovea.direction, made, hidden,
                    fovea.widens ? fovea.uncertainty_rad.value_or(0.0) / kRadiansPerDegree : 0.0);
    });
}

}  // namespace gazeloop::foveation
