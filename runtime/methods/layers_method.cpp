#include <fmt/core.h>

#include <utility>

#include "runtime/foveation/plans/layer_plan.h"
#include "runtime/methods/method.h"
#include "runtime/render/passes/layers_passes.h"

namespace gazeloop::methods {
namespace {

std::vector<settings::SettingRow> rows(MethodSettings& values) { return rows_of(values.layers); }

/// Errors (Usage): settings that do not fit together, both named.
Expected<void> check(const LayersSettings& layers) {
    if (layers.s2_fixed && layers.n < 3) {
        return std::unexpected(
            Error{ErrorKind::Usage,
                  fmt::format("layers.s2_fixed fixes the middle one of three or four layers, and "
                              "layers.n = {} leaves none: set layers.n to 3 or 4, or "
                              "layers.s2_fixed to false",
                              layers.n)});
    }
    return {};
}

Expected<PlannedMethod> plan(const PlanSubject& subject) {
    const LayersSettings& set = subject.values.layers;
    if (auto checked = check(set); !checked) {
        return std::unexpected(checked.error());
    }
    auto plan = foveation::plan_layers(subject.field, subject.line, parameters(set));
    if (!plan) {
        return std::unexpected(plan.error());
    }
    PlannedMethod method{
        .parameters = fmt::format("n {}{}, m {}", set.n, set.s2_fixed ? " with s2 = 2" : "",
                                  subject.line.slope),
        .samples = plan->samples(),
        .density = nullptr,
        .figures = {{"weighted_samples", plan->weighted_samples()}}};
    for (std::size_t i = 0; i < plan->layers.size(); ++i) {
        const foveation::PlannedLayer& layer = plan->layers[i];
        const auto add = [&](const char* what, double value) {
            method.figures.push_back({fmt::format("layer{}_{}", i + 1, what), value});
        };
        add("radius_deg", layer.radius_deg);
        add("factor", layer.factor);
        add("width", layer.width);
        add("height", layer.height);
    }
    method.density = std::make_unique<foveation::LayerDensity>(std::move(*plan));
    return method;
}

Expected<render::MakePasses> passes(const MethodSettings& values,
                                    const settings::Settings& /*settings*/) {
    const LayersSettings& set = values.layers;
    if (auto checked = check(set); !checked) {
        return std::unexpected(checked.error());
    }
    const render::LayersConfig config{.layers = static_cast<std::size_t>(set.n),
                                      .half_rate = set.half_rate,
                                      .over_frames = set.temporal};
    return [config, options = parameters(set),
            line = foveation::MarLine{.slope = values.acuity.mar}](const render::PassSetup& setup) {
        return render::make_layers_passes(setup, config, [=](const gaze::EyeView& view) {
            return foveation::optimised_layers(view, line, options);
        });
    };
}

}  // namespace

Method layers_method() {
    return {.name = "layers",
            .description = "eccentricity layers (Guenter et al. 2012): rectangles, coarser outward",
            .rows = rows,
            .follows_acuity = true,
            .plan = plan,
            .passes = passes};
}

}  // namespace gazeloop::methods
