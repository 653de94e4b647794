#pragma once

#include <string>

#include "runtime/profiles/profiles.h"
#include "runtime/run/frame_run.h"

namespace gazeloop::run {

/// The tracker of a source that --gaze names, after what that source and its profile decide has
/// become the value of settings that nobody configured. @throws SetupError for a profile that is
/// not there
[[nodiscard]] profiles::TrackerProfile take_tracker(const std::string& gaze,
                                                    ProgramSettings& settings);

/// A run on the gaze of that source; `settings` must outlive the request.
/// @throws SetupError as gaze_source_named()
[[nodiscard]] FrameRunRequest gaze_run(const std::string& gaze, RunClock clock,
                                       const profiles::TrackerProfile& tracker,
                                       const ProgramSettings& settings);

}  // namespace gazeloop::run
