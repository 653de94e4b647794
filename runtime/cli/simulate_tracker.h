#pragma once

#include "runtime/cli/commands.h"

namespace gazeloop::cli {

/// Adds `tracker` to `gazeloop simulate`.
void add_simulate_tracker_command(CLI::App& simulate, Action& action);

}  // namespace gazeloop::cli
