#include <fmt/core.h>

#include <utility>

#include "runtime/foveation/plans/shading_rings.h"
#include "runtime/methods/method.h"
#include "runtime/render/passes/rings_passes.h"

namespace gazeloop::methods {
namespace {

std::vector<settings::SettingRow> rows(MethodSettings& values) { return rows_of(values.rings); }

Expected<PlannedMethod> plan(const PlanSubject& subject) {
    const auto rings = parameters(subject.values.rings, subject.field.view(), subject.line);
    if (!rings) {
        return std::unexpected(rings.error());
    }
    auto plan = foveation::plan_rings(subject.field, *rings);
    if (!plan) {
        return std::unexpected(plan.error());
    }
    PlannedMethod method{
        .parameters = fmt::format("1x1 to {:.1f}, 2x2 to {:.1f} deg, tiles of {} px",
                                  rings->inner_deg, rings->outer_deg, rings->tile_px),
        .samples = plan->samples(),
        .density = nullptr,
        .figures = {{"inner_deg", rings->inner_deg},
                    {"outer_deg", rings->outer_deg},
                    {"samples_1x1", static_cast<double>(plan->samples_at[0])},
                    {"samples_2x2", static_cast<double>(plan->samples_at[1])},
                    {"samples_4x4", static_cast<double>(plan->samples_at[2])}}};
    method.density = std::make_unique<foveation::RingDensity>(std::move(*plan));
    return method;
}

Expected<render::MakePasses> passes(const MethodSettings& values,
                                    const settings::Settings& /*settings*/) {
    return [rings = values.rings,
            line = foveation::MarLine{.slope = values.acuity.mar}](const render::PassSetup& setup) {
        return render::make_rings_passes(
            setup, [=](const gaze::EyeView& view) { return parameters(rings, view, line); });
    };
}

}  // namespace

Method rings_method() {
    return {.name = "rings",
            .description = "rings of 1x1, 2x2 and 4x4 pixels per sample",
            .rows = rows,
            .follows_acuity = true,
            .plan = plan,
            .passes = passes};
}

}  // namespace gazeloop::methods
