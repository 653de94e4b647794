#pragma once

#include <memory>

#include "runtime/foveation/plans/kfr3d_plan.h"
#include "runtime/render/passes/method_passes.h"

namespace gazeloop::render {

/// 3D-KFR: the passes "pass_i" (all regions' LP-buffers), "disc", "lp_gaussian" where it is asked
/// for, "resolve". Throws SetupError (Usage) as foveation::region_sizes reports.
[[nodiscard]] std::unique_ptr<MethodPasses> make_kfr3d_passes(
    const PassSetup& setup, const foveation::Kfr3dParameters& parameters);

}  // namespace gazeloop::render
