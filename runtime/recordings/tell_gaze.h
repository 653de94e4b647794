#pragma once

#include <string>

#include "drivers/trace/read_options.h"
#include "runtime/report/gaze_page/gaze_outputs.h"

namespace gazeloop::recordings {

/// Which recorded gaze is to be looked at.
struct GazeQuestion {
    std::string file;   ///< a trace or a session
    std::string other;  ///< another recording of the same eyes at the same time; empty: none
    drivers::ReadOptions read{};
    report::GazeOutputs outputs{};
};

/// Says on stdout how far the gaze can be trusted, or how two recordings of it differ, unless an
/// output goes there. @throws SetupError: Usage for outputs that are not apart, BadInput for what
/// cannot be read, and, after all else is said, for what `run` and `replay` would refuse
void tell_gaze(const GazeQuestion& question);

}  // namespace gazeloop::recordings
