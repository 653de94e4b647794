#pragma once

#include <memory>

#include "runtime/foveation/log_polar/acuity_profile.h"
#include "runtime/foveation/log_polar/log_polar_map.h"
#include "runtime/render/passes/method_passes.h"

namespace gazeloop::render {

/// Kernel foveated rendering: pass I, disc and resolve. Throws SetupError (Usage) as lp_buffer_size
/// reports.
[[nodiscard]] std::unique_ptr<MethodPasses> make_kfr_passes(
    const PassSetup& setup, const foveation::KfrParameters& parameters);

/// The acuity-derived map, by the same passes. Its prepare() throws SetupError (Usage) as
/// AcuityProfile::create reports.
[[nodiscard]] std::unique_ptr<MethodPasses> make_acuity_passes(
    const PassSetup& setup, const foveation::AcuityParameters& parameters);

}  // namespace gazeloop::render
