#include <fmt/core.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

#include "runtime/foveation/plans/acuity_density.h"
#include "runtime/foveation/plans/acuity_plan.h"
#include "runtime/methods/method.h"
#include "runtime/render/passes/log_polar_passes.h"

namespace gazeloop::methods {
namespace {

std::vector<settings::SettingRow> rows(MethodSettings& values) { return rows_of(values.acuity); }

Expected<PlannedMethod> plan(const PlanSubject& subject) {
    const foveation::AcuityParameters acuity = parameters(subject.values.acuity);
    const gaze::EyeView& view = subject.field.view();
    const auto profile = foveation::AcuityProfile::create(acuity, view);
    if (!profile) {
        return std::unexpected(profile.error());
    }
    foveation::LogPolarPlan plan;
    foveation::plan_acuity(acuity, *profile, view, subject.field.gaze(), plan);
    const double core = plan.in_gaze_frame->disc_half_sine - plan.in_gaze_frame->border_half_sine;
    return PlannedMethod{
        .parameters = fmt::format("m {}, {}", acuity.mar.slope, acuity.disc ? "disc" : "no disc"),
        .samples = plan.texels.counts.shaded + plan.disc.counts.shaded,
        .density = std::make_unique<foveation::AcuityDensity>(
            foveation::AcuityMap(*profile, subject.field.frame()),
            glm::degrees(2.0 * std::asin(core))),
        .figures = {{"lp_width", static_cast<double>(plan.lp.width)},
                    {"lp_height", static_cast<double>(plan.lp.height)},
                    {"texels_shaded", static_cast<double>(plan.texels.counts.shaded)},
                    {"texels_off_screen", static_cast<double>(plan.texels.counts.off_screen)},
                    {"texels_under_disc", static_cast<double>(plan.texels.counts.covered)},
                    {"disc_pixels", static_cast<double>(plan.disc.counts.shaded)}}};
}

Expected<render::MakePasses> passes(const MethodSettings& values,
                                    const settings::Settings& /*settings*/) {
    return [acuity = parameters(values.acuity)](const render::PassSetup& setup) {
        return render::make_acuity_passes(setup, acuity);
    };
}

}  // namespace

Method acuity_method() {
    return {.name = "acuity",
            .description =
                "the log-polar map that the display and a MAR line ask for, in the gaze's frame",
            .rows = rows,
            .follows_acuity = true,
            .plan = plan,
            .passes = passes};
}

}  // namespace gazeloop::methods
