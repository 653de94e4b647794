#pragma once

#include <string>

#include "sim/gaze_simulation.h"

namespace gazeloop::simulate {

/// Writes a trace of simulated gaze of this length, and its sidecar; gives how many samples it has.
/// @throws SetupError: Usage for "-" and where nothing is left to write, BadInput for a file that
/// cannot be written
std::size_t write_gaze_file(const sim::GazeSimulation& simulation, double seconds,
                            const std::string& file);

}  // namespace gazeloop::simulate
