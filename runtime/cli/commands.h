#pragma once

#include <CLI/CLI.hpp>
#include <functional>
#include <string>

#include "runtime/cli/exit_code.h"

namespace gazeloop::cli {

/// What a chosen command does; throws SetupError for what it refuses.
using Action = std::function<ExitCode()>;

/// Each adds its command to the program and returns, through `action`, what to do if it is chosen.
void add_run_command(CLI::App& program, const std::string& command_line, Action& action);
void add_replay_command(CLI::App& program, const std::string& command_line, Action& action);
void add_numerics_command(CLI::App& program, Action& action);
void add_report_command(CLI::App& program, Action& action);
void add_plan_command(CLI::App& program, Action& action);
void add_simulate_command(CLI::App& program, Action& action);
void add_devices_command(CLI::App& program, Action& action);
void add_doctor_command(CLI::App& program, Action& action);
/// Hidden: what --preview starts.
void add_preview_window_command(CLI::App& program, Action& action);

}  // namespace gazeloop::cli
