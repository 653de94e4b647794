#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "drivers/trace/clock/rows_read.h"
#include "runtime/gaze/trace_report.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// Which rows of a trace are used, in which order, and when they were taken by the device's clock.
/// The vectors but `findings` are as long as `rows`.
struct DeviceTimes {
    memory::LongVector<std::size_t> rows;  ///< indices of the rows that are used, in order of time
    /// Since the first of them. Increases strictly.
    memory::LongVector<std::int64_t> time_ns;
    /// The device's own reading but for unit and wraps, from the first used row's if a tick is not
    /// 1 ns.
    memory::LongVector<std::int64_t> reading_ns;
    /// By how much later than `time_ns` the row may have been taken, because the clock counts in
    /// steps of that; 0: no such steps are seen.
    memory::LongVector<std::int64_t> step_ns;
    /// Whether the time is reckoned from the rows around, since the device's clock stood.
    memory::LongVector<bool> reckoned;
    /// Positions of rows before which the device's clock was set, ascending. The time between is
    /// the host's, or else the usual interval.
    memory::LongVector<std::size_t> sets;
    /// The usual time from one row to the next; 0: a single row.
    std::int64_t interval_ns = 0;
    /// Whether the readings are the host's, since no row has one of the device's clock.
    bool by_host = false;
    std::vector<gaze::TraceFinding> findings;
};

/// Judges the device's clock by its readings alone and, where there are host times, by these.
///
/// A step is judged by both its neighbours: a row, or a burst of up to 16 or of 50 ms (48 at most),
/// that agrees neither with what is before nor with what is after is left out (TimeOutlier). So is
/// a first row before, or a last row after, a gap that nothing else vouches for. Where what follows
/// a step back lasts, the clock was set, or is a counter that wrapped (counter_wrap.h; one that
/// does so every few rows is counted on by the host's clock); so it is after a step ahead that the
/// host's clock did not make. Other steps ahead are gaps. Rows mixed up within 64 are put in order
/// (row_order.h), a report that stands there twice is a Repeat. Rows of one time are spread over
/// the step that the clock makes (coarse_times.h), or follow the host's clock or the usual interval
/// where the clock stood.
///
/// A tick is `tick_ns` (> 0) long. Rows without device_ticks are not used (BadTime), unless no row
/// has any: then the host's clock is taken for the device's (BadTime). O(n log n); any readings are
/// safe.
[[nodiscard]] DeviceTimes device_times(const RowsRead& rows, double tick_ns);

}  // namespace gazeloop::drivers
