#pragma once

#include "runtime/render/frame_renderer.h"
#include "runtime/run/frame_run.h"

namespace gazeloop::run {

/// Throws SetupError for options and settings that contradict each other and for outputs that
/// cannot be written: before the set-up, which takes seconds, and before a run that takes longer.
void check_request(const FrameRunRequest& request);

/// Throws SetupError where the target's pictures do not fit those of the recording that is
/// replayed, whose views are taken as they are.
void check_recorded_target(const FrameRunRequest& request, const render::RendererConfig& config);

/// Throws SetupError for parameters by which no picture is worth drawing. What was recorded by them
/// is replayed nevertheless, with a warning.
void check_picture(const FrameRunRequest& request, const render::RendererConfig& config);

}  // namespace gazeloop::run
