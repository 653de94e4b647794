#include <fmt/core.h>

#include <utility>

#include "runtime/foveation/plans/fixed_plan.h"
#include "runtime/methods/method.h"
#include "runtime/methods/registry.h"
#include "runtime/render/passes/fixed_passes.h"

namespace gazeloop::methods {
namespace {

const Method& held(const MethodSettings& values) { return *find_method(values.fixed.method); }

std::vector<settings::SettingRow> rows(MethodSettings& values) { return rows_of(values.fixed); }

Expected<PlannedMethod> plan(const PlanSubject& subject) {
    const auto ahead =
        foveation::GazeField::create(subject.field.view(), foveation::kStraightAhead);
    if (!ahead) {
        return std::unexpected(ahead.error());
    }
    auto planned = held(subject.values)
                       .plan({.values = subject.values,
                              .settings = subject.settings,
                              .field = *ahead,
                              .line = subject.line});
    if (!planned) {
        return planned;
    }
    planned->parameters =
        fmt::format("{} held ahead: {}", subject.values.fixed.method, planned->parameters);
    planned->density =
        std::make_unique<foveation::FixedDensity>(std::move(planned->density), *ahead);
    return planned;
}

Expected<void> check_picture(const MethodSettings& values, const settings::Settings& settings,
                             foveation::ImageSize image) {
    const auto check = held(values).check_picture;
    return check != nullptr ? check(values, settings, image) : Expected<void>{};
}

Expected<render::MakePasses> passes(const MethodSettings& values,
                                    const settings::Settings& settings) {
    auto make = held(values).passes(values, settings);
    if (!make) {
        return make;
    }
    return [make = *std::move(make)](const render::PassSetup& setup) {
        return render::make_fixed_passes(make(setup));
    };
}

}  // namespace

Method fixed_method() {
    return {.name = "fixed",
            .description = "a method with the fovea held straight ahead, as without eye tracking",
            .rows = rows,
            .plan = plan,
            .uses_gaze = false,
            .check_picture = check_picture,
            .passes = passes};
}

}  // namespace gazeloop::methods
