#include "drivers/trace/trace_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace gazeloop::drivers {

TraceRows::TraceRows(CsvTable& table, gaze::PerEye<EyeCells>& eyes, TraceOrigin origin)
    : table_(table), eyes_(eyes), builder_(std::move(origin)) {}

std::optional<std::int64_t> TraceRows::ticks(std::size_t column, std::string_view ticks) {
    const std::optional<std::int64_t> value = table_.whole(column);
    if (!value && !builder_.knows_unread_time()) {
        builder_.unread_time(
            fmt::format("{} is no whole number of {}", table_.described(column), ticks));
    }
    return value;
}

std::optional<std::int64_t> TraceRows::decimal_ticks(std::size_t column, int digits,
                                                     std::string_view unit) {
    const std::optional<std::int64_t> value = table_.decimal(column, digits);
    if (!value && !builder_.knows_unread_time()) {
        builder_.unread_time(fmt::format("{} is no time in {}", table_.described(column), unit));
    }
    return value;
}

void TraceRows::only_where(std::function<bool()> is_gaze, std::string_view what) {
    is_gaze_ = std::move(is_gaze);
    others_ = what;
}

std::optional<std::int64_t> TraceRows::optional_ticks(std::optional<std::size_t> column) {
    if (!column) {
        return std::nullopt;
    }
    const std::optional<std::int64_t> value = table_.whole(*column);
    if (!value) {
        refuse_unless_missing(RowPart::Other, *column);
    }
    return value;
}

std::optional<std::uint64_t> TraceRows::optional_count(std::optional<std::size_t> column) {
    if (!column) {
        return std::nullopt;
    }
    const std::optional<std::uint64_t> value = table_.count(*column);
    if (!value) {
        refuse_unless_missing(RowPart::Other, *column);
    }
    return value;
}

void TraceRows::make_room() {
    // A file may be far larger than its rows: no more than some two hours of 1 kHz.
    constexpr std::uint64_t kMost = 8'000'000;
    constexpr std::uint64_t kShorterLines = 32;  // one row more in so many
    if (const std::optional<std::uint64_t> ahead = table_.rows_ahead()) {
        builder_.expect(std::min(rows_ + *ahead + *ahead / kShorterLines, kMost));
    }
}

void TraceRows::refuse_unless_missing(RowPart part, std::size_t column) {
    if (!table_.is_missing(column)) {
        bad_.add(part, table_.line(),
                 [&] { return fmt::format("{} is no whole number", table_.described(column)); });
    }
}

void TraceRows::refuse_head(std::size_t column, std::string_view why) {
    bad_.add(RowPart::Head, table_.line(),
             [&] { return fmt::format("{} {}", table_.described(column), why); });
}

void TraceRows::refuse_eyes(TraceRow& row, std::string_view why) {
    auto refused = std::ranges::find(refused_, why, &Refused::why);
    if (refused == refused_.end()) {
        refused = refused_.insert(refused_.end(), {.why = why, .first_line = row.line});
    }
    ++refused->rows;
    for (gaze::EyeRay& ray : row.eyes) {
        ray.valid = false;
    }
}

Expected<gaze::GazeTrace> TraceRows::finish(const ReadOptions& options) {
    gaze::TraceReport& report = builder_.report();
    table_.report_to(report);
    bad_.report_to(report);
    for (const EyeCells& eye : eyes_) {
        eye.report_to(report);
    }
    for (const Refused& refused : refused_) {
        report.add({.kind = gaze::TraceFindingKind::RefusedByBit,
                    .line = refused.first_line,
                    .rows = refused.rows,
                    .text = fmt::format("gaze not vouched for in {} {}: {}", refused.rows,
                                        refused.rows == 1 ? "row" : "rows", refused.why)});
    }
    if (left_out_ > 0) {
        report.add({.kind = gaze::TraceFindingKind::Text,
                    .line = first_left_out_,
                    .rows = left_out_,
                    .text = fmt::format("{} {} {}: left out", left_out_,
                                        left_out_ == 1 ? "row" : "rows", others_)});
    }
    if (rows_ == 0 || any_valid_) {
        return builder_.finish(options);
    }
    std::string message = fmt::format("{}: no valid gaze in {} {}", table_.name(), rows_,
                                      rows_ == 1 ? "row" : "rows");
    for (const gaze::TraceFinding& finding : report.findings()) {
        if (finding.kind == gaze::TraceFindingKind::BadCells ||
            finding.kind == gaze::TraceFindingKind::RefusedByBit) {
            message += fmt::format("; from line {}: {}", finding.line, finding.text);
        }
    }
    return std::unexpected(Error{
        ErrorKind::BadInput, message + ": set the tracker up for these eyes, and record again"});
}

}  // namespace gazeloop::drivers
