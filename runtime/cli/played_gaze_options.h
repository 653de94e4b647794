#pragma once

#include <string>

#include "runtime/cli/run_options.h"
#include "runtime/simulate/played_gaze.h"

namespace gazeloop::cli {

/// The options of commands that play gaze, again and again, to whoever listens.
struct PlayedGazeOptions {
    LogOptions log;
    std::string axes = "none";
    simulate::PlayedGaze gaze;

    void add_to(Command command);
    [[nodiscard]] simulate::PlayedGaze played() const;
};

}  // namespace gazeloop::cli
