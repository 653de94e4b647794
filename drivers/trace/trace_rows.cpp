#include "drivers/trace/trace_rows.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace gazeloop::drivers {
namespace {

/// What to do about a time of day or a date.
std::string_view remedy_of_time(std::string_view cell) {
    return cell.find(':') == std::string_view::npos
               ? ""
               : " but a time of day: write how long it is since the first row instead";
}

}  // namespace

TraceRows::TraceRows(CsvTable& table, gaze::PerEye<EyeCells>& eyes, TraceOrigin origin)
    : table_(table), eyes_(eyes), builder_(std::move(origin)) {}

std::optional<std::int64_t> TraceRows::ticks(std::size_t column, std::string_view ticks) {
    const std::optional<std::int64_t> value = table_.whole(column);
    if (!builder_.knows_clock()) {
        builder_.clock_is(table_.name_of(column), builder_.origin().device_tick_ns);
    }
    if (!value && !builder_.knows_unread_time()) {
        builder_.unread_time(fmt::format("{} is no whole number of {}{}", table_.described(column),
                                         ticks, remedy_of_time(table_.text(column))));
    }
    return value;
}

std::optional<std::int64_t> TraceRows::decimal_ticks(std::size_t column, int digits,
                                                     std::string_view unit) {
    const std::optional<std::int64_t> value = table_.decimal(column, digits);
    if (!builder_.knows_clock()) {
        builder_.clock_is(table_.name_of(column), std::pow(10.0, digits));
    }
    if (!value && !builder_.knows_unread_time()) {
        builder_.unread_time(fmt::format("{} is no time in {}{}", table_.described(column), unit,
                                         remedy_of_time(table_.text(column))));
    }
    return value;
}

void TraceRows::only_where(std::function<bool()> is_gaze, std::string_view what) {
    is_gaze_ = std::move(is_gaze);
    others_ = what;
}

bool TraceRows::is_of_another() {
    constexpr std::size_t kNamed = 16;
    const std::string_view name = table_.text(*recording_column_);
    if (!recordings_.empty() && (name == recordings_.front().name || name.empty())) {
        return false;
    }
    const auto known = std::ranges::find(recordings_, name, &Recording::name);
    if (known != recordings_.end()) {
        ++known->rows;
    } else if (recordings_.size() < kNamed) {
        recordings_.push_back(
            {std::string{name}, table_.quoted(*recording_column_), 1, table_.line()});
    } else {
        ++of_unnamed_;
    }
    return recordings_.size() > 1;
}

void TraceRows::report_other_recordings() {
    if (recordings_.size() < 2) {
        return;
    }
    constexpr std::size_t kListed = 4;
    std::uint64_t others = of_unnamed_;
    std::string list;
    for (std::size_t i = 1; i < recordings_.size(); ++i) {
        others += recordings_[i].rows;
        if (i <= kListed) {
            list += fmt::format("{}{} ({} rows)", i == 1 ? "" : ", ", recordings_[i].quoted,
                                recordings_[i].rows);
        }
    }
    if (recordings_.size() > kListed + 1) {
        list += " and more";
    }
    gaze::TraceReport& report = builder_.report();
    report.rows += others;
    report.add(
        {.kind = gaze::TraceFindingKind::OtherRecording,
         .line = recordings_[1].first_line,
         .rows = others,
         .dropped = others,
         .text = fmt::format("only {} is read, which the first row is of by '{}'; left out: "
                             "{}; write the rows of each to a file of its own to read it",
                             recordings_[0].quoted, table_.name_of(*recording_column_), list)});
}

std::optional<std::int64_t> TraceRows::arrival_ticks(std::optional<std::size_t> column) {
    if (!column) {
        return std::nullopt;
    }
    const std::optional<std::int64_t> value = table_.whole(*column);
    if (value) {
        bad_.has(RowDetail::Arrival);
    } else {
        refuse_optional(RowDetail::Arrival, *column);
    }
    return value;
}

std::optional<std::uint64_t> TraceRows::sequence(std::optional<std::size_t> column) {
    if (!column) {
        return std::nullopt;
    }
    if (const std::optional<std::uint64_t> value = table_.count(*column)) {
        bad_.has(RowDetail::Sequence);
        sequence_.add(*value);
        return value;
    }
    if (const std::optional<std::int64_t> negative = table_.whole(*column)) {
        sequence_.add_negative(*negative, [&] { return table_.described(*column); });
        return static_cast<std::uint64_t>(*negative);
    }
    refuse_optional(RowDetail::Sequence, *column);
    return std::nullopt;
}

void TraceRows::settle_negative_numbers() {
    if (!sequence_.any_negative()) {
        return;
    }
    const std::optional<std::uint64_t> range = sequence_.range(rows_);
    std::optional<std::uint64_t> first_line;
    for (RowClock& row : builder_.clocks()) {
        if (!row.sequence || !SignedCounts::is_negative(*row.sequence)) {
            continue;
        }
        if (range) {
            first_line = first_line.value_or(row.line);
            row.sequence = *row.sequence + *range;
        } else {
            row.sequence.reset();
            bad_.add(RowPart::Other, row.line, [&] {
                return fmt::format("{} is no whole number from 0 on", sequence_.first_negative());
            });
        }
    }
    if (first_line) {
        builder_.report().add(
            {.kind = gaze::TraceFindingKind::SequenceRestarted,
             .line = *first_line,
             .rows = 1,
             .text =
                 fmt::format("{}: the numbers of a counter with a sign: counted on by adding {} "
                             "to those below 0",
                             sequence_.first_negative(), *range)});
    }
}

void TraceRows::make_room() {
    // A file may be far larger than its rows: no more than some two hours of 1 kHz.
    constexpr std::uint64_t kMost = 8'000'000;
    constexpr std::uint64_t kShorterLines = 32;  // one row more in so many
    if (const std::optional<std::uint64_t> ahead = table_.rows_ahead()) {
        builder_.expect(std::min(rows_ + *ahead + *ahead / kShorterLines, kMost));
    }
}

void TraceRows::refuse_optional(RowDetail detail, std::size_t column) {
    if (table_.is_missing(column)) {
        bad_.lacks(detail, table_.line(), [&] { return table_.described(column); });
    } else {
        bad_.add(RowPart::Other, table_.line(),
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

void TraceRows::lose_eyes(TraceRow& row, std::string_view why) {
    for (const gaze::Eye eye : gaze::kEyes) {
        row.eyes[gaze::index(eye)].valid = false;
        bad_.add(direction_of(eye), row.line, [why] { return std::string{why}; });
    }
}

Expected<BuiltTrace> TraceRows::finish(const ReadOptions& options) {
    gaze::TraceReport& report = builder_.report();
    table_.report_to(report);
    settle_negative_numbers();
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
    report_other_recordings();
    if (rows_ == 0 && left_out_ > 0) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}:{}: all {} rows are {}: export the eye tracker's rows too",
                              table_.name(), first_left_out_, left_out_, others_)});
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
    const bool unreadable = report.count(gaze::TraceFindingKind::BadCells).rows > 0;
    return std::unexpected(Error{
        ErrorKind::BadInput,
        message + (unreadable ? ": mend these cells, or set the tracker up for these eyes and "
                                "record again"
                              : ": set the tracker up for these eyes, and record again")});
}

}  // namespace gazeloop::drivers
