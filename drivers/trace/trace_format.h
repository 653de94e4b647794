#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "drivers/trace/built_trace.h"
#include "drivers/trace/read_options.h"
#include "drivers/trace/text/csv_table.h"
#include "runtime/error.h"

namespace gazeloop::drivers {

using ColumnNames = std::span<const std::string_view>;

/// The file itself, for formats that read what stands beside it; empty for a stream.
using TraceFile = std::filesystem::path;

/// A kind of file that holds a trace, known by its columns.
struct TraceFormat {
    std::string_view name;  ///< as --format and GazeTrace::format have it
    ColumnNames columns;    ///< all that are read, in any order
    /// What a fovea point cannot do without: of each of these lists of alternatives, the header has
    /// all columns of at least one.
    std::span<const std::span<const ColumnNames>> needed;
    /// Reads the rows of a table that has what is needed.
    Expected<BuiltTrace> (*read)(CsvTable& table, const TraceFile& file,
                                 const ReadOptions& options);
    /// What to do where a table that is this format by some of its columns lacks a needed one.
    std::string_view remedy = {};
};

}  // namespace gazeloop::drivers
