#pragma once

#include <istream>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/trace/read_options.h"
#include "runtime/error.h"
#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::drivers {

/// As --format and GazeTrace::format have them.
[[nodiscard]] std::vector<std::string_view> trace_format_names();

/// Reads a recorded trace. The format is options.format, or known by the header's column names, by
/// a JSON object in the first line, or by a name as BIDS gives them.
/// What the file has that is not usual, and what was not used or changed, is in the trace's report.
///
/// Errors: Usage for a format that does not exist. BadInput, naming the file and where it applies
/// the line, for a file that is missing, a directory, empty, not a table of text (csv_table.h), or
/// whose header no format knows. BadInput also for a row of the wrong width, no row, or no row with
/// a valid eye, and for gaze that points behind the head (axes_correction.h). A cell that cannot be
/// read is no error (trace_rows.h).
[[nodiscard]] Expected<gaze::GazeTrace> read_trace(const std::string& file,
                                                   const ReadOptions& options = {});

/// The same of a file of any length, whose samples are read as often as they are asked for: of it
/// there are a scratch file and what MemoryLimit leaves in memory.
[[nodiscard]] Expected<gaze::GazeRecording> read_recording(const std::string& file,
                                                           const ReadOptions& options = {});

/// As read_trace(), from a stream; `name` is the file's name in messages and in the trace. Nothing
/// that stands beside a file is read; formats that need it are refused.
[[nodiscard]] Expected<gaze::GazeTrace> read_trace(std::istream& in, const std::string& name,
                                                   const ReadOptions& options = {});

}  // namespace gazeloop::drivers
