#include <fmt/core.h>

#include <utility>

#include "runtime/foveation/plans/layer_plan.h"
#include "runtime/methods/method.h"
#include "runtime/render/passes/layers_passes.h"

namespace gazeloop::methods {
namespace {

std::vector<settings::SettingRow> rows(MethodSettings& values) { return rows_of(values.quad); }

Expected<PlannedMethod> plan(const PlanSubject& subject) {
    const QuadSettings& set = subject.values.quad;
    foveation::LayerPlan plan;
    for (const foveation::LayerShape& shape : layers(set)) {
        plan.layers.push_back(foveation::plan_layer(subject.field, shape));
    }
    const auto samples = [&](std::size_t layer) {
        return static_cast<double>(std::uint64_t{plan.layers[layer].width} *
                                   plan.layers[layer].height);
    };
    PlannedMethod method{
        .parameters =
            fmt::format("inset of {} of the sides, {} outside", set.section, set.periphery),
        .samples = plan.samples(),
        .density = nullptr,
        .figures = {{"samples_inset", samples(0)}, {"samples_outside", samples(1)}}};
    method.density = std::make_unique<foveation::LayerDensity>(std::move(plan));
    return method;
}

Expected<render::MakePasses> passes(const MethodSettings& values,
                                    const settings::Settings& /*settings*/) {
    return [made = layers(values.quad)](const render::PassSetup& setup) {
        return render::make_layers_passes(
            setup, {.layers = made.size()},
            [made](const gaze::EyeView& /*view*/) -> Expected<std::vector<foveation::LayerShape>> {
                return made;
            });
    };
}

}  // namespace

Method quad_method() {
    return {.name = "quad",
            .description =
                "quad views as headsets run them: an inset at full resolution that "
                "follows the gaze, the rest coarser",
            .rows = rows,
            .plan = plan,
            .passes = passes};
}

}  // namespace gazeloop::methods
