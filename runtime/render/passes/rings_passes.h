#pragma once

#include <memory>

#include "runtime/foveation/plans/shading_rings.h"
#include "runtime/render/passes/method_passes.h"

namespace gazeloop::render {

/// Rings of one sample per pixel, per 2 x 2 and per 4 x 4 pixels. Its prepare() throws SetupError
/// (Usage) as `rings_of` and plan_rings report.
[[nodiscard]] std::unique_ptr<MethodPasses> make_rings_passes(
    const PassSetup& setup, foveation::RingsPlan::RingsOf rings_of);

}  // namespace gazeloop::render
