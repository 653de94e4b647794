#pragma once

#include <span>
#include <string>

#include "runtime/report/output_file.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::simulate {

/// Writes a trace of simulated gaze of this length, and its sidecar, over nothing of what is read;
/// gives how many samples it has.
/// @throws SetupError: Usage for "-" and where nothing is left to write, BadInput for a file that
/// cannot be written
std::size_t write_gaze_file(const sim::GazeSimulation& simulation, double seconds,
                            const std::string& file, std::span<const report::NamedFile> reads);

}  // namespace gazeloop::simulate
