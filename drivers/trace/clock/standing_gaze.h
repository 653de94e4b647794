#pragma once

#include <span>
#include <vector>

#include "drivers/trace/clock/device_times.h"
#include "drivers/trace/clock/rows_read.h"
#include "runtime/gaze/trace_report.h"

namespace gazeloop::drivers {

/// Finds reports that stand in the file again with later times (Repeat, nothing is dropped): for
/// more than two seconds, where the tracker or its recorder stood still, and in a quarter of the
/// rows or more at most 7 times each, where the recorder polls faster than the tracker reports.
/// Fixations without noise, as made traces have them, are neither. A report with a number of its
/// own, or without a valid eye, is another one. Where all reports of a longer file are the
/// same, that is said as Text. O(n).
[[nodiscard]] std::vector<gaze::TraceFinding> standing_gaze(const RowsRead& rows,
                                                            const DeviceTimes& times);

}  // namespace gazeloop::drivers
