#pragma once

#include <memory>

#include "runtime/display/display_profile.h"
#include "runtime/present/frame_target.h"
#include "runtime/present/openxr/openxr_target.h"
#include "runtime/run/frame_run.h"

namespace gazeloop::run {

/// The profile that the settings name. For a headless replay of a recording: what the recording
/// says of its display, because the profile may have changed or be gone. Throws SetupError if it
/// cannot be read.
[[nodiscard]] display::DisplayProfile display_of(const FrameRunRequest& request);

/// Throws SetupError if there is no runtime, or none that can be used.
[[nodiscard]] std::unique_ptr<present::OpenXrTarget> make_openxr_target(
    const FrameRunRequest& request, const display::DisplayProfile& display);

/// The headless target. A replay of a recording gets the sizes and the format of its pictures.
/// Throws SetupError for an unknown format.
[[nodiscard]] std::unique_ptr<present::FrameTarget> make_headless_target(
    const FrameRunRequest& request, const display::DisplayProfile& display);

}  // namespace gazeloop::run
