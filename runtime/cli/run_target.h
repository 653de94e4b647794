#pragma once

#include <memory>

#include "runtime/cli/frame_run.h"
#include "runtime/present/display_profile.h"
#include "runtime/present/frame_target.h"
#include "runtime/present/openxr/openxr_target.h"

namespace gazeloop::cli {

/// The profile that the settings name; for a replay of a recording off screen, what the recording
/// says of its display, since the profile may have changed or be gone.
/// Throws SetupError if it cannot be read.
[[nodiscard]] present::DisplayProfile display_of(const FrameRunRequest& request);

/// Throws SetupError where there is no runtime, or none that can be used.
[[nodiscard]] std::unique_ptr<present::OpenXrTarget> make_openxr_target(
    const FrameRunRequest& request, const present::DisplayProfile& display);

/// Off screen, with the pictures' sizes and format of the recording that is replayed, if one is.
/// Throws SetupError for a format that is not known.
[[nodiscard]] std::unique_ptr<present::FrameTarget> make_headless_target(
    const FrameRunRequest& request, const present::DisplayProfile& display);

}  // namespace gazeloop::cli
