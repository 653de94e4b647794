#pragma once

#include <istream>
#include <string>
#include <string_view>

#include "runtime/error.h"
#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::drivers {

/// Reads a recorded trace. `format` is "auto" (by the header's column names), "gazeloop" or
/// "htc-vive-pro".
///
/// Errors: Usage for a format that does not exist. BadInput, naming the file and where it applies
/// the line, for a file that is missing, a directory, empty or not text, or whose header no format
/// knows. BadInput also for a row of the wrong width, a cell that the format does not allow, no
/// row, or no row with a valid eye. Rows whose time does not advance are no error: Trace counts
/// them.
[[nodiscard]] Expected<gaze::GazeTrace> read_trace(const std::string& file,
                                                   std::string_view format = "auto");

/// The same from a stream; `name` is the file's name in messages and in the trace. No sidecar.
[[nodiscard]] Expected<gaze::GazeTrace> read_trace(std::istream& in, const std::string& name,
                                                   std::string_view format = "auto");

}  // namespace gazeloop::drivers
