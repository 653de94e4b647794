#pragma once

#include <string>
#include <vector>

#include "runtime/latency/latency_summary.h"

namespace gazeloop::report {

/// A row of a report with its names.
struct NamedRow {
    std::string key;    ///< for programs, e.g. "stage_wait_for_display"
    std::string label;  ///< for people; stages are indented below their sum
    const latency::DurationRow* row;
};

/// The rows of a report, in the order in which they are shown. They are those that every run has,
/// and of the rest (the display's rows, passes, held gaze) those for which some frame has a value.
/// They point into the report.
std::vector<NamedRow> rows_of(const latency::SummaryReport& report);

}  // namespace gazeloop::report
