#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/trace/clock/device_times.h"
#include "drivers/trace/clock/trace_row.h"
#include "runtime/error.h"
#include "runtime/gaze/eye.h"
#include "runtime/gaze/trace_report.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// What one file has of one eye, or of both.
struct EyeRows {
    std::string name;  ///< of the file, without folders
    gaze::PerEye<bool> of{};
    double stated_rate_hz = 0.0;        ///< as its sidecar has it, > 0
    memory::LongVector<TraceRow> rows;  ///< as the file has them; a tick is 1 ns
};

/// The rows of both eyes' files as one table.
struct JoinedEyes {
    memory::LongVector<TraceRow> rows;
    std::uint64_t dropped = 0;  ///< rows of either file that are not among them
    std::vector<gaze::TraceFinding> findings;
};

/// Doubts a stated rate that is more than a tenth off the times' own (OddTimes).
[[nodiscard]] std::vector<gaze::TraceFinding> doubt_stated_rate(const EyeRows& eye,
                                                                const DeviceTimes& times);

/// Puts rows of the same time together. The clock of each file is judged by itself before
/// (device_times.h), so that a time outlier, a repeat or a row out of order in one file moves no
/// row of the other. Where both files have the very same times, that is left to who reads the
/// joined rows. Where more than a tenth of the rows find no partner, that is an OddTimes. O(n log
/// n).
[[nodiscard]] Expected<JoinedEyes> join_eyes(const EyeRows& first, const EyeRows& second);

}  // namespace gazeloop::drivers
