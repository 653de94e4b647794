#pragma once

#include <optional>

#include "drivers/trace/clock/row_clock.h"
#include "runtime/gaze/eye.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/pose.h"

namespace gazeloop::drivers {

/// One row of a trace file as a format's reader took it apart.
struct TraceRow : RowClock {
    gaze::PerEye<gaze::EyeRay> eyes;     ///< in our axes and units
    std::optional<double> parallax_rad;  ///< as GazeSample has it
    std::optional<gaze::Pose> head;
    /// Whether an eye is invalid because a cell of it holds something that is not understood.
    bool not_understood = false;
};

}  // namespace gazeloop::drivers
