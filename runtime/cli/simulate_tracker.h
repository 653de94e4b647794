#pragma once

#include "runtime/cli/command_line.h"

namespace gazeloop::cli {

/// Adds `tracker` to `gazeloop simulate`.
void add_simulate_tracker_command(Command simulate);

}  // namespace gazeloop::cli
