#pragma once

#include <string>

#include "drivers/trace/read_options.h"
#include "runtime/cli/command_line.h"
#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::cli {

/// The options of commands that read a trace or a session's gaze.
struct RecordedGazeOptions {
    drivers::ReadOptions read;
    std::string axes = "none";

    void add_to(Command app);
};

/// As --format lists them: "auto, gazeloop, ...".
[[nodiscard]] std::string trace_formats_text();

/// The trace, or the session's gaze. @throws SetupError (BadInput) for a file that is refused
[[nodiscard]] gaze::GazeTrace recorded_gaze(const std::string& file,
                                            const RecordedGazeOptions& options);

/// The same, but a trace of which too much was dropped or changed is looked at all the same;
/// `refusal` then says what a run would.
[[nodiscard]] gaze::GazeTrace recorded_gaze_even_refused(const std::string& file,
                                                         const RecordedGazeOptions& options,
                                                         std::string& refusal);

}  // namespace gazeloop::cli
