#pragma once

#include <string>

#include "drivers/trace/read_options.h"
#include "runtime/command_line/command_line.h"

namespace gazeloop::cli {

/// The options of commands that read a trace or a session's gaze.
struct RecordedGazeOptions {
    drivers::ReadOptions read;
    std::string axes = "none";

    void add_to(Command app);
    [[nodiscard]] drivers::ReadOptions read_options() const;
};

/// As --format lists them: "auto, gazeloop, ...".
[[nodiscard]] std::string trace_formats_text();

}  // namespace gazeloop::cli
