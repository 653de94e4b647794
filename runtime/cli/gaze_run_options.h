#pragma once

#include <optional>
#include <string>

#include "runtime/cli/run_options.h"
#include "runtime/run/frame_run.h"

namespace gazeloop::cli {

/// The options of commands that run the loop on the gaze of a source.
struct GazeRunOptions {
    RunOptions options;
    std::string gaze = "fixed:0,0";
    std::string clock = "wall";

    void add_to(Command command);

    /// Sets what the options say in `settings`, which must outlive the request, and gives the run
    /// that they ask for. None: --print-config asked for the settings alone, which have been
    /// printed. Throws SetupError for what cannot be.
    [[nodiscard]] std::optional<run::FrameRunRequest> prepare(
        run::ProgramSettings& settings, const std::string& command_line) const;
};

}  // namespace gazeloop::cli
