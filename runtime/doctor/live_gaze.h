#pragma once

#include <functional>
#include <vector>

#include "drivers/gaze_source.h"

namespace gazeloop::doctor {

/// Shows live gaze on stdout, ten times a second: in one line of a terminal, else a line each.
/// Silence is told, each second of it where lines stay. Ends after `seconds`, or where
/// `interrupted` says so. Whether any eye was seen.
[[nodiscard]] bool watch_gaze(const std::vector<drivers::GazeSource*>& sources, double seconds,
                              const std::function<bool()>& interrupted);

}  // namespace gazeloop::doctor
