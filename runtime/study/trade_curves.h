#pragma once

#include <filesystem>
#include <vector>

#include "runtime/study/plan.h"
#include "runtime/study/simulated_study.h"

namespace gazeloop::study {

/// How much a plan's levels differ from full resolution by the foveated contrast metric, whose unit
/// is the difference that its models take to be just seen: of what `gazeloop trade --json` has
/// found for them. One curve per condition. Errors (BadInput), with the file: it cannot be read or
/// is no such result; a cell of the plan is not in it, or was not compared by that metric.
[[nodiscard]] Expected<std::vector<DifferenceCurve>> trade_curves(
    const Plan& plan, const std::filesystem::path& file);

}  // namespace gazeloop::study
