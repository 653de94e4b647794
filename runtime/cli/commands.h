#pragma once

#include <string>

#include "runtime/command_line/command_line.h"

namespace gazeloop::cli {

/// Each adds its command to the program, with what is done if it is chosen.
void add_run_command(Command program, const std::string& command_line);
void add_replay_command(Command program, const std::string& command_line);
void add_numerics_command(Command program);
void add_probe_command(Command program, const std::string& command_line);
void add_report_command(Command program);
void add_convert_command(Command program);
void add_gaze_command(Command program);
void add_plan_command(Command program);
void add_calibrate_command(Command program, const std::string& command_line);
void add_compare_command(Command program);
void add_trade_command(Command program, const std::string& command_line);
void add_simulate_command(Command program);
/// Those within it.
void add_simulate_tracker_command(Command simulate);
void add_simulate_steam_frame_command(Command simulate);
void add_simulate_gaze_command(Command simulate);
void add_simulate_light_field_command(Command simulate);
void add_study_command(Command program, const std::string& command_line);
void add_devices_command(Command program);
void add_doctor_command(Command program);
void add_layer_command(Command program);
/// Hidden: what --preview starts.
void add_preview_window_command(Command program);

}  // namespace gazeloop::cli
