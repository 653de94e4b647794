#pragma once

#include "drivers/openxr/gaze_gates.h"
#include "runtime/doctor/checks.h"

namespace gazeloop::doctor {

/// One finding per gate, "openxr.eye_gaze.NAME"; gates behind one that is shut were not reached.
[[nodiscard]] Findings eye_gaze_findings(const drivers::GazeGates& gates);

}  // namespace gazeloop::doctor
