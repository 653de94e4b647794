#pragma once

#include "drivers/trace/trace_format.h"

namespace gazeloop::drivers {

/// The data export of Tobii Pro Lab, TSV: a direction per eye. Rows of other sensors stand between
/// those of the column Sensor that say "Eye Tracker", and are left out; of several recordings
/// (Recording name) the first is read. The unit of Recording timestamp stands in its name ([ms],
/// [us], [μs], [s]) and is needed.
///
/// Axes: of glasses, whose eyes stand in columns Pupil position (HUCS), +X is left, +Y up, +Z
/// forward. Of trackers at a screen (DACS, columns Eye position) +X is right, +Y down, -Z toward
/// the screen; the head's frame is then taken to be the screen's. An eye is vouched for by its
/// validity, "Valid" or "Invalid"; without the column by having a direction.
[[nodiscard]] const TraceFormat& tobii_pro_lab();

}  // namespace gazeloop::drivers
