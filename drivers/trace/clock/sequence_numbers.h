#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "drivers/trace/clock/device_times.h"
#include "drivers/trace/clock/rows_read.h"
#include "runtime/gaze/trace_report.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// The numbers of a trace's samples.
struct SequenceNumbers {
    /// Of each used row. Those of the file where it counts up, and counted on where it begins anew;
    /// a gap is what the tracker lost, never a row that was left out here.
    memory::LongVector<std::uint64_t> numbers;
    /// None where there are no numbers, over a tenth of the rows has none, they do not count, or
    /// they begin anew across a gap: nobody knows then.
    std::optional<std::uint64_t> lost;
    std::vector<gaze::TraceFinding> findings;
};

/// Judges the sequence by both neighbours. A number that only its neighbours' agreement rules out
/// is an outlier (SequenceOutlier); one that goes back, or ahead by more than the time that went by
/// has room for, begins anew (SequenceRestarted). It wrapped if it did so within 4 of 2^8, 2^16 or
/// 2^32, or if the count over such a wrap is within a fifth, and 4, of what the time has room for;
/// what was lost there counts too. Rows that were filed up to 256 late are not lost; they are
/// numbered where they stand (SequenceOutlier). Where more than a tenth of the numbers do not
/// follow, or nearly all go on by one number above 1 at even times, so that it is either the
/// tracker's way to count or every other report is missing, they count nothing (one
/// SequenceOutlier). Then, without sequence numbers, or where all
/// are the same, rows are numbered from 0. O(n log n).
[[nodiscard]] SequenceNumbers sequence_numbers(const RowsRead& rows, const DeviceTimes& times);

}  // namespace gazeloop::drivers
