#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

#include "drivers/trace/trace_format.h"
#include "runtime/error.h"
#include "runtime/gaze/trace_report.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::drivers {

/// Numbers by time, ascending: what a table that stands beside a trace says.
struct TimedNumbers {
    memory::LongVector<std::int64_t> time_ns{};
    memory::LongVector<double> numbers{};  ///< `columns` per time
    std::size_t columns = 0;

    [[nodiscard]] std::span<const double> at(std::size_t row) const {
        return std::span{numbers}.subspan(row * columns, columns);
    }
    /// The last row that is not later; none where all are.
    [[nodiscard]] std::optional<std::size_t> row_until(std::int64_t time) const;
    /// The row that is nearest, where it is within `within_ns`.
    [[nodiscard]] std::optional<std::size_t> row_near(std::int64_t time,
                                                      std::int64_t within_ns) const;
};

/// Takes what is noteworthy of a companion, "imu.csv: 3 rows cannot be read, the first is line 7",
/// as a Text or, where it is not used, NotRead.
using CompanionNotes = std::function<void(std::string, gaze::TraceFindingKind)>;

/// Reads columns of FOLDER/`name`, where FOLDER is the trace's; without such a file, .gz too. Rows
/// with a cell that holds no number are left out, and noted. None where there is no such file, the
/// trace is a stream, or the table lacks a column (noted). Errors (BadInput): those of CsvTable.
[[nodiscard]] Expected<std::optional<TimedNumbers>> read_companion(
    const TraceFile& trace, std::string_view name, std::string_view time_column_ns,
    std::span<const std::string_view> columns, const CompanionNotes& note);

}  // namespace gazeloop::drivers
