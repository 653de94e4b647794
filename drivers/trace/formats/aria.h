#pragma once

#include "drivers/trace/trace_format.h"

namespace gazeloop::drivers {

/// Eye gaze of Project Aria's MPS (general_eye_gaze.csv, personalized_eye_gaze.csv): times in us,
/// angles in radians in the central pupil frame (+X left, +Y up, +Z forward).
///
/// - Generation 2 has yaw and pitch of each eye: (sin yaw cos pitch, sin pitch, cos yaw cos pitch).
/// - Generation 1 has a yaw of each eye and a pitch for both: along (tan yaw, tan pitch, 1).
/// - Older files have a yaw and a pitch for both eyes, written as generation 1's; they meet at
///   depth_m where that is above 0.
///
/// Source: projectaria_tools, EyeGazeReader.
[[nodiscard]] const TraceFormat& aria();

}  // namespace gazeloop::drivers
