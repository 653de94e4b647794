#pragma once

#include "runtime/gaze/gaze_trace.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::sim {

/// A recording of the simulated tracker, `seconds` (> 0) long: what SimulatedSource hands over, as
/// a trace. Arrival times are there if the tracker has a delay or jitter. Without them, and with
/// every other tracker term off, it is what a perfect tracker would report.
[[nodiscard]] gaze::GazeTrace generate_gaze(const GazeSimulation& simulation, double seconds);

}  // namespace gazeloop::sim
