#pragma once

#include <span>
#include <string_view>

#include "drivers/trace/csv_table.h"
#include "runtime/error.h"
#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::drivers {

/// A kind of file that holds a trace, known by its columns.
struct TraceFormat {
    std::string_view name;                      ///< as --format and GazeTrace::format have it
    std::span<const std::string_view> columns;  ///< the header has all of these, in any order
    /// Reads the rows of a table that has the columns.
    Expected<gaze::GazeTrace> (*read)(CsvTable& table);
};

}  // namespace gazeloop::drivers
