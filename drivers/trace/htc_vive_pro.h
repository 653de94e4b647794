#pragma once

#include "drivers/trace/trace_format.h"

namespace gazeloop::drivers {

/// CSV of HTC's SRanipal (Vive Pro Eye), one row per report, with the helmet's pose where the
/// columns helmet_pos_* and helmet_rot_* exist.
///
/// In the file the gaze's axes are +X left, +Y up, +Z forward. The helmet's are Unity's: +X right,
/// +Y up, +Z forward, left-handed, rotations in degrees about z, then x, then y of the world. Both
/// are turned into ours. Origins are millimetres.
///
/// An eye's validity has five bits: the direction is valid by bit 1, the origin known by bit 0, the
/// openness by bit 3; what they refuse is counted. Only a time and, of one eye, direction and
/// validity are needed.
///
/// Time is time(100ns), without that time_stamp(ms), which wraps. The rows have no number: the
/// column `frame` repeats numbers for rows that differ, so it cannot count losses.
[[nodiscard]] const TraceFormat& htc_vive_pro();

}  // namespace gazeloop::drivers
