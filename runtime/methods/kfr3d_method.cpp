#include <fmt/core.h>

#include <utility>

#include "runtime/foveation/plans/kfr3d_plan.h"
#include "runtime/methods/method.h"
#include "runtime/methods/registry.h"
#include "runtime/render/passes/kfr3d_passes.h"

namespace gazeloop::methods {
namespace {

std::vector<settings::SettingRow> rows(MethodSettings& values) { return rows_of(values.kfr3d); }

/// Of one view it is this method.
const Method& of_one_view() { return *find_method("kfr"); }

Expected<foveation::Kfr3dParameters> all_parameters(const MethodSettings& values,
                                                    const settings::Settings& settings) {
    auto kfr = parameters(values.kfr, settings);
    if (!kfr) {
        return std::unexpected(kfr.error());
    }
    return foveation::Kfr3dParameters{.kfr = *std::move(kfr),
                                      .regions = static_cast<std::uint32_t>(values.kfr3d.regions),
                                      .inner = values.kfr3d.inner,
                                      .growth = values.kfr3d.growth};
}

Expected<PlannedMethod> plan(const PlanSubject& subject) {
    const auto kfr3d = all_parameters(subject.values, subject.settings);
    if (!kfr3d) {
        return std::unexpected(kfr3d.error());
    }
    auto planned = of_one_view().plan(subject);
    if (!planned) {
        return planned;
    }
    planned->parameters += fmt::format(", {} regions, growth {}", kfr3d->regions, kfr3d->growth);
    const auto sizes = foveation::region_sizes(*kfr3d, subject.image());
    if (!sizes) {
        return std::unexpected(sizes.error());
    }
    for (std::uint32_t region = 1; region < kfr3d->regions; ++region) {
        planned->figures.push_back(
            {fmt::format("lp_width_{}", region), static_cast<double>(sizes->at(region).width)});
        planned->figures.push_back(
            {fmt::format("lp_height_{}", region), static_cast<double>(sizes->at(region).height)});
    }
    return planned;
}

Expected<void> check_picture(const MethodSettings& values, const settings::Settings& settings,
                             foveation::ImageSize image) {
    return of_one_view().check_picture(values, settings, image);
}

Expected<render::MakePasses> passes(const MethodSettings& values,
                                    const settings::Settings& settings) {
    auto kfr3d = all_parameters(values, settings);
    if (!kfr3d) {
        return std::unexpected(kfr3d.error());
    }
    return [kfr3d = *std::move(kfr3d)](const render::PassSetup& setup) {
        return render::make_kfr3d_passes(setup, kfr3d);
    };
}

}  // namespace

Method kfr3d_method() {
    return {.name = "kfr3d",
            .description =
                "KFR for light fields (Meng et al. 2020): views far from the gaze are coarser",
            .rows = rows,
            .plan = plan,
            .check_picture = check_picture,
            .passes = passes};
}

}  // namespace gazeloop::methods
