#pragma once

#include <memory>

#include "runtime/display/display_profile.h"
#include "runtime/present/frame_target.h"
#include "runtime/present/openxr/openxr_target.h"
#include "runtime/run/frame_run.h"

namespace gazeloop::run {

/// The profile that the settings name; for a replay of a recording off screen, what the recording
/// says of its display, since the profile may have changed or be gone.
/// Throws SetupError if it cannot be read.
[[nodiscard]] display::DisplayProfile display_of(const FrameRunRequest& request);

/// Throws SetupError where there is no runtime, or none that can be used.
[[nodiscard]] std::unique_ptr<present::OpenXrTarget> make_openxr_target(
    const FrameRunRequest& request, const display::DisplayProfile& display);

/// Off screen, with the pictures' sizes and format of the recording that is replayed, if one is.
/// Throws SetupError for a format that is not known.
[[nodiscard]] std::unique_ptr<present::FrameTarget> make_headless_target(
    const FrameRunRequest& request, const display::DisplayProfile& display);

}  // namespace gazeloop::run
