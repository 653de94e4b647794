#pragma once

#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::recordings {

/// Logs each thing that a trace's reader found, with file and line: as warnings if much of the
/// trace is concerned, else as information.
void log_trace(const gaze::GazeTrace& trace);

}  // namespace gazeloop::recordings
