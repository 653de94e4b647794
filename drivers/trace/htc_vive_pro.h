#pragma once

#include "drivers/trace/trace_format.h"

namespace gazeloop::drivers {

/// CSV of HTC's SRanipal (Vive Pro Eye), one row per report, with the helmet's pose where the
/// columns helmet_pos_* and helmet_rot_* exist.
///
/// In the file the gaze's axes are +X left, +Y up, +Z forward. The helmet's are Unity's: +X right,
/// +Y up, +Z forward, left-handed, rotations in degrees about z, then x, then y of the world. Both
/// are turned into ours. Origins are millimetres. An eye is valid if its flags are 31 (all five
/// bits) and its direction is not zero. Time is time(100ns), which becomes device_ns relative to
/// the first row; time_stamp(ms) wraps and is not used. The rows are numbered from 0: the column
/// `frame` repeats numbers for rows that differ, so it cannot count losses.
[[nodiscard]] const TraceFormat& htc_vive_pro();

}  // namespace gazeloop::drivers
