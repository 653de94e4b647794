#pragma once

#include "runtime/frame/passes.h"
#include "runtime/frame/sample_counts.h"
#include "runtime/present/frame_target.h"
#include "runtime/run/frame_run.h"
#include "runtime/session/session_header.h"
#include "runtime/vulkan/context.h"

namespace gazeloop::run {

/// What a session says of its run before the first frame: the time of this call, settings, display,
/// target and the device that draws. `passes` and `grids` are those that the run may use.
[[nodiscard]] session::SessionHeader run_header(
    const FrameRunRequest& request, const display::DisplayProfile& display,
    latency::LoopClock clock, const present::FrameTarget& target, const vulkan::Context& context,
    const frame::PassList& passes, const frame::GridList& grids);

}  // namespace gazeloop::run
