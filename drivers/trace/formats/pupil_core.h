#pragma once

#include "drivers/trace/trace_format.h"

namespace gazeloop::drivers {

/// gaze_positions.csv of Pupil Core's Player: a direction per eye (gaze_normal0 is the right eye's,
/// gaze_normal1 the left one's) and the eyeballs' centres (eye_center, mm) in the scene camera's
/// axes (+X right, +Y down, +Z forward), taken for the head's. A row is vouched for where its
/// confidence is above .6, which is what Pupil's documentation calls useful. Times are seconds of
/// Pupil's own clock. norm_pos_x and norm_pos_y alone need the camera's geometry and are refused.
[[nodiscard]] const TraceFormat& pupil_core();

}  // namespace gazeloop::drivers
