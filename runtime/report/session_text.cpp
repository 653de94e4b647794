#include "runtime/report/session_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <iterator>
#include <span>
#include <vector>

#include "runtime/report/eye_event_rows.h"
#include "runtime/report/figures.h"
#include "runtime/report/row_names.h"
#include "runtime/report/session_rows.h"
#include "runtime/report/summary_text.h"
#include "runtime/report/wrapped_row.h"

namespace gazeloop::report {
namespace {

constexpr std::size_t kFigure = 6;  // characters; a column has a blank more
constexpr std::size_t kWorstFrames = 10;

void append_cells(std::string& line, const std::vector<std::string>& cells) {
    for (const std::string& cell : cells) {
        fmt::format_to(std::back_inserter(line), "{:>7}", cell);
    }
}

std::string line_of(std::string_view label, std::string_view kind, std::string_view frames,
                    const std::vector<std::string>& cells) {
    std::string line = fmt::format("{:<22}{:<10}{:>9}", label, kind, frames);
    append_cells(line, cells);
    return line + "\n";
}

std::string line_of(const SessionRow& row) {
    std::vector<std::string> cells{figure(row.least, kFigure), figure(row.mean, kFigure)};
    std::ranges::transform(row.percentiles, std::back_inserter(cells),
                           [](const auto& value) { return figure(value, kFigure); });
    cells.push_back(figure(row.greatest, kFigure));
    return line_of(row.name.label, kind_text(row.frames_by_kind), count_text(row.known), cells);
}

std::string head_line(std::string_view unit, const Percentiles& percentiles) {
    std::vector<std::string> cells{"min", "mean"};
    std::ranges::copy(percentiles.names(), std::back_inserter(cells));
    cells.emplace_back("max");
    return line_of(unit, "kind", "frames", cells);
}

std::string table(std::span<const SessionRow> rows, const Percentiles& percentiles) {
    std::string text;
    for (const auto& [unit, name] :
         {std::pair{Unit::Nanoseconds, "milliseconds"}, std::pair{Unit::Microdegrees, "degrees"}}) {
        text += head_line(name, percentiles);
        for (const SessionRow& row : rows) {
            text += row.unit == unit ? line_of(row) : "";
        }
    }
    const bool withheld = std::ranges::any_of(rows, [](const SessionRow& row) {
        return std::ranges::any_of(row.percentiles, [](const auto& one) { return !one; });
    });
    if (withheld) {
        text += "-: unknown, or withheld because a percentile p needs 1 / (1 - p) frames\n";
    }
    if (std::ranges::any_of(rows, [](const SessionRow& row) {
            return kind_text(row.frames_by_kind).ends_with('+');
        })) {
        text += "+: the least certain kind of several\n";
    }
    return text;
}

/// Nothing where all frames are of one event: the table above has its figures.
std::string eye_event_table(const FrameLog& frames, const Percentiles& percentiles) {
    const EyeEventRows rows = rows_by_eye_event(frames, percentiles.percents());
    if (rows.ages.size() < 2) {
        return {};
    }
    std::string text = head_line("age by eye event, ms", percentiles);
    for (const SessionRow& row : rows.ages) {
        text += line_of(row);
    }
    text += head_line("error by eye event", percentiles);
    for (const SessionRow& row : rows.errors) {
        text += line_of(row);
    }
    return text + wrapped_row("", source_text(rows), 2);
}

std::string below_zero_lines(const FrameLog& frames) {
    std::string text;
    for (const std::string& sentence : below_zero(frames)) {
        text += sentence + "\n";
    }
    return text;
}

std::string error_lines(const FrameLog& frames) {
    const auto gaps = [&frames](frame::GazeErrorGap gap) {
        return frames.gaze_error_gaps()[static_cast<std::size_t>(gap)];
    };
    std::string text;
    const auto add = [&text](std::uint64_t of, std::string_view why) {
        if (of > 0) {
            text += fmt::format("{} {} {}", text.empty() ? "gaze error unknown:" : ",", of, why);
        }
    };
    add(gaps(frame::GazeErrorGap::NoDisplayTime), "without display time");
    add(gaps(frame::GazeErrorGap::NoSampleNear), "without a sample within 25 ms");
    add(gaps(frame::GazeErrorGap::EyeLost), "with the eye lost");
    add(gaps(frame::GazeErrorGap::NoHead), "with poses for lack of them");
    return text.empty() ? text : text + "\n";
}

std::string worst_frames(const FrameLog& frames) {
    const std::vector<std::size_t> worst = frames.worst(kWorstFrames);
    if (worst.empty()) {
        return {};
    }
    std::vector<const DurationColumn*> columns;
    std::vector<std::string> heads;
    const auto add = [&](const std::string& key, const std::string& head) {
        if (frames.at(key).known() > 0) {
            columns.push_back(&frames.at(key));
            heads.push_back(head);
        }
    };
    add(kGazeAgeAtDisplay.key, "age");
    for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
        constexpr auto kShort =
            std::to_array<std::string_view>({"track", "deliv", "queue", "filter", "submit", "gpu",
                                             "compos", "wait", "row", "switch"});
        static_assert(kShort.size() == latency::kStageCount);
        add(stage_name(stage).key, std::string(kShort[stage]));
    }
    add(kUnaccounted.key, "unacc");
    add(kGazeError.key, "error");
    std::string text = fmt::format("{:<22}", "worst frames (ms, deg)");
    append_cells(text, heads);
    text += "\n";
    for (const std::size_t row : worst) {
        std::vector<std::string> cells;
        for (const DurationColumn* const column : columns) {
            const auto number = column->at(row);
            cells.push_back(
                figure(number ? std::optional(shown(static_cast<double>(*number), column->unit()))
                              : std::nullopt,
                       kFigure));
        }
        fmt::format_to(std::back_inserter(text), "{:<22}",
                       fmt::format("{:>10}", frames.number(row)));
        append_cells(text, cells);
        text += "\n";
    }
    return text + "\n";
}

}  // namespace

std::string session_text(const SessionSummary& session, const Percentiles& percentiles,
                         std::string_view lag) {
    const FrameLog& frames = *session.frames;
    const std::vector<SessionRow> rows = rows_of(frames, percentiles.percents());
    const std::string why = lag.empty() ? std::string{} : fmt::format("\n{}", lag);
    return summary_head(session.report) + why + "\n" + table(rows, percentiles) +
           eye_event_table(frames, percentiles) + below_zero_lines(frames) + error_lines(frames) +
           summary_notes(session.report) + "\n" + worst_frames(frames) +
           summary_counts(session.report);
}

}  // namespace gazeloop::report
