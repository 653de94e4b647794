#pragma once

#include "runtime/render/frame_renderer.h"
#include "runtime/run/frame_run.h"

namespace gazeloop::run {

/// Throws SetupError for options and settings that contradict each other, and for outputs that
/// cannot be written. To be called before the set-up, which takes seconds, and the run, which takes
/// longer.
void check_request(const FrameRunRequest& request);

/// Throws SetupError for results (of the options that name them) that cannot be written, or would
/// be written over each other, over the run's recording, or over what it reads.
void check_results(const FrameRunRequest& request, std::vector<report::NamedFile> results);

/// Throws SetupError if the target's pictures do not fit those of the replayed recording, whose
/// views are used as they are.
void check_recorded_target(const FrameRunRequest& request, const render::RendererConfig& config);

/// Throws SetupError for parameters by which no picture is worth drawing. A recording made with
/// them is still replayed, with a warning.
void check_picture(const FrameRunRequest& request, const render::RendererConfig& config);

}  // namespace gazeloop::run
