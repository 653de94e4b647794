#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/latency/span_series.h"
#include "runtime/report/frame_log.h"
#include "runtime/report/row_names.h"

namespace gazeloop::report {

/// One quantity over all frames of a session, exact: milliseconds, degrees or a count, as its unit
/// is. Percentiles lie in the order in which they were asked for; none: withheld.
struct SessionRow {
    RowName name;
    Unit unit = Unit::Nanoseconds;
    std::uint64_t known = 0;  ///< frames that know it
    std::array<std::uint64_t, time::kStampKindCount> frames_by_kind{};
    std::uint64_t negative = 0;  ///< frames whose number is below 0
    std::optional<double> least;
    std::optional<double> mean;
    std::vector<std::optional<double>> percentiles;
    std::optional<double> greatest;
};

/// A column's number as it is shown.
[[nodiscard]] double shown(double number, Unit unit);

[[nodiscard]] SessionRow row_of(const DurationColumn& column, std::span<const double> percents);

/// The rows that a report shows, in the log's order: all but those of parts that the session does
/// not have (a stage that is left out where it is unknown, held gaze, a pass that never ran).
[[nodiscard]] std::vector<SessionRow> rows_of(const FrameLog& frames,
                                              std::span<const double> percents);

/// A sentence for each quantity that is below 0 in some frames, where a stamp or a clock must be
/// wrong. Only a row's emission may come before what is counted as the display's.
[[nodiscard]] std::vector<std::string> below_zero(const FrameLog& frames);

}  // namespace gazeloop::report
