#pragma once

#include <string>

#include "drivers/trace/read_options.h"
#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::recordings {

/// The trace, or the session's gaze. @throws SetupError (BadInput) for a file that is refused
[[nodiscard]] gaze::GazeRecording recorded_gaze(const std::string& file,
                                                const drivers::ReadOptions& options);

/// The same, but a trace of which too much was dropped or changed is looked at all the same;
/// `refusal` then says what a run would.
[[nodiscard]] gaze::GazeRecording recorded_gaze_even_refused(const std::string& file,
                                                             const drivers::ReadOptions& options,
                                                             std::string& refusal);

}  // namespace gazeloop::recordings
