#pragma once

#include <string>
#include <vector>

#include "runtime/run/frame_run.h"

namespace gazeloop::run {

/// A line for each setting of the command line that changes nothing in this run, by the settings in
/// force, its gaze, scene, target and clock, or that does something else than it says. What a file
/// sets may be there for other runs: nothing is said of it.
[[nodiscard]] std::vector<std::string> without_effect(const FrameRunRequest& request);

}  // namespace gazeloop::run
