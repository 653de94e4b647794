#pragma once

#include "drivers/trace/trace_format.h"

namespace gazeloop::drivers {

/// CSV of GazeBaseVR (Lohr et al. 2023, Scientific Data 10:177), 250 Hz: n is the time in ms, lx
/// and ly, rx and ry are each eye's angles in degrees, h = atan2(x, hypot(y, z)) and
/// v = atan2(y, z), positive right and up; clx to crz are the centres of the eyeballs in metres.
[[nodiscard]] const TraceFormat& gazebase_vr();

}  // namespace gazeloop::drivers
