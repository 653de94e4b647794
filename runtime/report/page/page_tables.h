#pragma once

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/report/page/distribution.h"
#include "runtime/report/page/report_page.h"
#include "runtime/report/page/table.h"
#include "runtime/report/page/violations.h"
#include "runtime/report/session_rows.h"

namespace gazeloop::report::page {

inline constexpr std::size_t kWorstFrames = 10;

/// "12.345 s" below a minute, then "2:03.456", then "1:02:03.456". None: "unknown".
[[nodiscard]] std::string time_text(const std::optional<double>& seconds);
/// On the plots' axis, seconds: since the first wake-up of a frame; none: unknown.
[[nodiscard]] std::optional<double> axis_s(const FrameLog& frames, std::size_t row);

/// A table of quantities: its heads, and the line of one of them.
[[nodiscard]] std::vector<TableHead> quantity_heads(const Percentiles& percentiles);
[[nodiscard]] TableRow quantity_line(const SessionRow& row);

[[nodiscard]] Table stage_table(const FrameLog& frames, const Percentiles& percentiles);
/// The frames with the oldest gaze, one column for each.
[[nodiscard]] Table worst_table(const FrameLog& frames);
[[nodiscard]] Table violation_table(const FrameLog& frames, std::span<const Violations> all);
/// The longest runs of each.
[[nodiscard]] Table run_table(const FrameLog& frames, std::span<const Violations> all);
/// One distribution for each column head.
[[nodiscard]] Table distribution_table(std::span<const Distribution> distributions,
                                       const std::vector<TableHead>& heads);
/// The session in parts of as many frames each, with least, mean and greatest of each column.
[[nodiscard]] Table range_table(const FrameLog& frames, std::span<const std::string> keys);
/// The same with means alone.
[[nodiscard]] Table mean_table(const FrameLog& frames, std::span<const std::string> keys);
[[nodiscard]] Table state_table(const FrameLog& frames);
/// The share of each part that is above each limit.
[[nodiscard]] Table above_table(const FrameLog& frames, std::span<const Violations> all);

[[nodiscard]] Table happening_table(const latency::SummaryReport& report);
/// Every kind of event, and when the first of them were.
[[nodiscard]] Table event_table(const EventLine& events, const FrameLog& frames);
/// What was said of clocks.
[[nodiscard]] Table clock_table(const EventLine& events, const FrameLog& frames);
[[nodiscard]] Table repair_table(const TraceAccount& trace);
[[nodiscard]] Table count_table(const PageContents& contents);
[[nodiscard]] Table named_values(std::span<const NamedValue> values);

}  // namespace gazeloop::report::page
