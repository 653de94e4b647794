#include <fmt/core.h>

#include <utility>

#include "runtime/foveation/plans/sparse_pattern.h"
#include "runtime/methods/method.h"
#include "runtime/render/passes/sparse_passes.h"

namespace gazeloop::methods {
namespace {

std::vector<settings::SettingRow> rows(MethodSettings& values) { return rows_of(values.sparse); }

Expected<PlannedMethod> plan(const PlanSubject& subject) {
    const foveation::SparseParameters sparse = parameters(subject.values.sparse);
    const auto pattern = foveation::make_sparse_pattern(sparse, subject.image());
    if (!pattern) {
        return std::unexpected(pattern.error());
    }
    const gaze::PixelPosition fovea = subject.field.fovea();
    return PlannedMethod{
        .parameters = fmt::format(
            "share {}, {}", sparse.share,
            sparse.placement == foveation::SparsePlacement::BlueNoise ? "blue noise" : "gaussian"),
        .samples = pattern->samples_in(fovea),
        .density = std::make_unique<foveation::SparseDensity>(pattern->profile, fovea),
        .figures = {{"field_samples", static_cast<double>(pattern->samples.size())},
                    {"disc_radius_px", pattern->profile.disc_radius_px}}};
}

Expected<render::MakePasses> passes(const MethodSettings& values,
                                    const settings::Settings& /*settings*/) {
    const SparseSettings& set = values.sparse;
    const render::SparseConfig config{.plan = {.pattern = parameters(set),
                                               .neighbours = static_cast<std::uint32_t>(set.k),
                                               .turn = set.turn},
                                      .depth_guided = set.depth_guided,
                                      .accumulate = set.accumulate};
    return [config](const render::PassSetup& setup) {
        return render::make_sparse_passes(setup, config);
    };
}

}  // namespace

Method sparse_method() {
    return {.name = "sparse",
            .description = "scattered samples and a disc",
            .rows = rows,
            .plan = plan,
            .passes = passes};
}

}  // namespace gazeloop::methods
