#include <fmt/core.h>

#include <utility>

#include "runtime/foveation/log_polar/degenerate_map.h"
#include "runtime/foveation/plans/kfr_density.h"
#include "runtime/foveation/plans/kfr_plan.h"
#include "runtime/methods/method.h"
#include "runtime/render/passes/log_polar_passes.h"

namespace gazeloop::methods {
namespace {

std::vector<settings::SettingRow> rows(MethodSettings& values) { return rows_of(values.kfr); }

Expected<PlannedMethod> plan(const PlanSubject& subject) {
    const KfrSettings& set = subject.values.kfr;
    const auto stated = parameters(set, subject.settings);
    if (!stated) {
        return std::unexpected(stated.error());
    }
    const foveation::KfrParameters& kfr = *stated;
    const foveation::ImageSize image = subject.image();
    const auto lp = foveation::lp_buffer_size(kfr, image);
    if (!lp) {
        return std::unexpected(lp.error());
    }
    foveation::LogPolarPlan plan;
    const gaze::PixelPosition fovea = subject.field.fovea();
    foveation::plan_kfr(kfr, *lp, image, fovea, plan);
    const foveation::LogPolarMap map(kfr.kernel, image, fovea);
    const double core_px = plan.disc_radius_px - plan.disc_border_px;
    return PlannedMethod{
        .parameters = fmt::format(
            "sigma {}, {}, {}", set.sigma,
            set.kernel == "power" ? fmt::format("alpha {}", set.alpha) : "kernel " + set.kernel,
            set.disc ? "disc" : "no disc"),
        .samples = plan.texels.counts.shaded + plan.disc.counts.shaded,
        .density = std::make_unique<foveation::KfrDensity>(map, *lp, fovea, core_px),
        .figures = {{"lp_width", static_cast<double>(lp->width)},
                    {"lp_height", static_cast<double>(lp->height)},
                    {"texels_shaded", static_cast<double>(plan.texels.counts.shaded)},
                    {"texels_off_screen", static_cast<double>(plan.texels.counts.off_screen)},
                    {"texels_under_disc", static_cast<double>(plan.texels.counts.covered)},
                    {"disc_pixels", static_cast<double>(plan.disc.counts.shaded)},
                    {"disc_radius_px", plan.disc_radius_px}},
        .useless = foveation::why_degenerate(map, *lp, core_px)};
}

Expected<void> check_picture(const MethodSettings& values, const settings::Settings& settings,
                             foveation::ImageSize image) {
    const auto kfr = parameters(values.kfr, settings);
    if (!kfr) {
        return std::unexpected(kfr.error());
    }
    const auto lp = foveation::lp_buffer_size(*kfr, image);
    if (!lp) {
        return std::unexpected(lp.error());
    }
    const gaze::PixelPosition middle{image.width_px / 2.0, image.height_px / 2.0};
    foveation::LogPolarPlan plan;
    foveation::plan_kfr(*kfr, *lp, image, middle, plan);
    const std::string why =
        foveation::why_degenerate(foveation::LogPolarMap(kfr->kernel, image, middle), *lp,
                                  plan.disc_radius_px - plan.disc_border_px);
    if (why.empty()) {
        return {};
    }
    return std::unexpected(Error{
        ErrorKind::Usage,
        fmt::format(
            "kfr draws nothing worth seeing with {}x{} texels for {}x{} px: {}: use a smaller "
            "kfr.sigma, a larger kfr.lp_width, or another kfr.alpha or kfr.kernel (gazeloop plan "
            "shows what each does)",
            lp->width, lp->height, image.width_px, image.height_px, why)});
}

Expected<render::MakePasses> passes(const MethodSettings& values,
                                    const settings::Settings& settings) {
    const auto kfr = parameters(values.kfr, settings);
    if (!kfr) {
        return std::unexpected(kfr.error());
    }
    return [kfr = *kfr](const render::PassSetup& setup) {
        return render::make_kfr_passes(setup, kfr);
    };
}

}  // namespace

Method kfr_method() {
    return {.name = "kfr",
            .description =
                "kernel foveated rendering (Meng et al. 2018): a log-polar buffer and a disc",
            .rows = rows,
            .plan = plan,
            .check_picture = check_picture,
            .passes = passes};
}

}  // namespace gazeloop::methods
