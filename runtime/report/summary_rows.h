#pragma once

#include <cstddef>
#include <vector>

#include "runtime/latency/latency_summary.h"
#include "runtime/report/row_names.h"

namespace gazeloop::report {

class FrameLog;

/// A row of a report with its names.
struct NamedRow {
    RowName name;
    const latency::DurationRow* row;
};

/// The rows of a report, in the order in which they are shown. They are those that every run has,
/// and of the rest (the display's rows, passes, held gaze) those for which some frame has a value.
/// They point into the report.
std::vector<NamedRow> rows_of(const latency::SummaryReport& report);

/// Makes the percentiles of all rows those of the frames themselves: a run's summary, which takes
/// no more memory for more frames, has them from a histogram. Precondition: the report is of these
/// frames.
void take_exact_percentiles(const FrameLog& frames, latency::SummaryReport& report);

}  // namespace gazeloop::report
