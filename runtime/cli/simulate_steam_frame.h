#pragma once

#include "runtime/cli/command_line.h"

namespace gazeloop::cli {

/// Adds `steam-frame` to `gazeloop simulate`.
void add_simulate_steam_frame_command(Command simulate);

}  // namespace gazeloop::cli
