#pragma once

#include <string_view>
#include <vector>

#include "runtime/study/plan.h"

namespace gazeloop::study {

/// The papers' studies: kfr-pilot and kfr-final (Meng, Du, Zwicker and Varshney 2018, "Kernel
/// Foveated Rendering", 4.2 and 4.3), f3d-pair, f3d-ramp and f3d-slider (Guenter, Finch, Drucker,
/// Tan and Snyder 2012, "Foveated 3D Graphics", 5). What the papers leave open is chosen here, and
/// `Plan::source` says so.
[[nodiscard]] const std::vector<Plan>& published_plans();

/// Null: there is none of that name.
[[nodiscard]] const Plan* published_plan(std::string_view name);

}  // namespace gazeloop::study
