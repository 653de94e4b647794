#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "drivers/trace/bad_cells.h"
#include "drivers/trace/clock/signed_counts.h"
#include "drivers/trace/clock/trace_row.h"
#include "drivers/trace/eye_cells.h"
#include "drivers/trace/read_options.h"
#include "drivers/trace/text/csv_table.h"
#include "drivers/trace/trace_builder.h"
#include "runtime/error.h"

namespace gazeloop::drivers {

/// Takes the rows of a table to a trace, for every format alike: what a format adds is where its
/// columns stand and what their numbers mean. No cell is an error: what it would have said is
/// unknown, and counted where the row claims otherwise.
class TraceRows {
  public:
    /// The table and the eyes must outlive the rows.
    TraceRows(CsvTable& table, gaze::PerEye<EyeCells>& eyes, TraceOrigin origin);

    /// Rows of which `is_gaze` is false are those of another stream, as files with several sensors
    /// have them: they are left out, and noted as `what`. The table's current row is asked for.
    void only_where(std::function<bool()> is_gaze, std::string_view what);
    /// A column names the recording that a row is of. Those of another than the first row's are
    /// dropped, counted and named (OtherRecording).
    void one_recording(std::size_t column) { recording_column_ = column; }

    /// Reads all rows; `take_apart(row)` fills in what is not line or eyes, by the functions below,
    /// and may take an eye's validity back. Errors: those of the table and of the builder; no row
    /// with a valid eye.
    template <typename TakeApart>
    [[nodiscard]] Expected<BuiltTrace> read(const ReadOptions& options,
                                            const TakeApart& take_apart);

    /// The reading of the clock that gives a row its time; none where the cell holds none, of which
    /// the first is kept for messages: it is no whole number of `ticks` ("nanoseconds").
    [[nodiscard]] std::optional<std::int64_t> ticks(std::size_t column, std::string_view ticks);
    /// The same of a clock in units of its `digits`th decimal; `unit` as the file has it
    /// ("seconds").
    [[nodiscard]] std::optional<std::int64_t> decimal_ticks(std::size_t column, int digits,
                                                            std::string_view unit);
    /// When the host had the row, by a clock that a row can do without.
    [[nodiscard]] std::optional<std::int64_t> arrival_ticks(std::optional<std::size_t> column);
    /// The number of the row's report, which it can do without. A counter with a sign is read too,
    /// where it turns negative behind the end of its range.
    [[nodiscard]] std::optional<std::uint64_t> sequence(std::optional<std::size_t> column);

    /// The numbers of the head's pose. None where all cells are missing, or where one of them
    /// cannot be read, which is counted: the former where other rows have a pose.
    template <std::size_t Count>
    [[nodiscard]] std::optional<std::array<double, Count>> head(
        const std::array<std::size_t, Count>& columns);
    /// Counts a pose whose numbers make none.
    void refuse_head(std::size_t column, std::string_view why);

    /// Takes back the validity of eyes that the file itself does not vouch for, and counts the row
    /// by the reason, which is a literal: "during a blink (blink id)".
    void refuse_eyes(TraceRow& row, std::string_view why);

    /// The same where the numbers themselves tell: counted as bad cells.
    void lose_eyes(TraceRow& row, std::string_view why);

  private:
    /// Rows after which it is guessed how many there will be.
    static constexpr std::uint64_t kGuessedFrom = 1024;
    /// So that the rows are not moved again and again while they become more.
    void make_room();
    void refuse_optional(RowDetail detail, std::size_t column);
    /// Makes a counter with a sign one without, or its negative numbers unknown and counted.
    void settle_negative_numbers();
    /// Whether the current row is of another recording; counts it.
    [[nodiscard]] bool is_of_another();
    void report_other_recordings();
    [[nodiscard]] Expected<BuiltTrace> finish(const ReadOptions& options);

    CsvTable& table_;
    struct Recording {
        std::string name;
        std::string quoted;  ///< as messages show it
        std::uint64_t rows = 0;
        std::uint64_t first_line = 0;
    };
    struct Refused {
        std::string_view why;
        std::uint64_t rows = 0;
        std::uint64_t first_line = 0;
    };

    gaze::PerEye<EyeCells>& eyes_;
    TraceBuilder builder_;
    std::function<bool()> is_gaze_;  ///< empty: all are
    std::string_view others_;
    std::uint64_t left_out_ = 0;
    std::uint64_t first_left_out_ = 0;
    std::optional<std::size_t> recording_column_;
    std::vector<Recording> recordings_;  ///< the first is read
    std::uint64_t of_unnamed_ = 0;       ///< rows of recordings beyond the few that are named
    std::vector<Refused> refused_;
    SignedCounts sequence_;
    BadCells bad_;
    std::uint64_t rows_ = 0;
    bool any_valid_ = false;
};

template <typename TakeApart>
Expected<BuiltTrace> TraceRows::read(const ReadOptions& options, const TakeApart& take_apart) {
    while (true) {
        const Expected<bool> more = table_.next();
        if (!more) {
            return std::unexpected(more.error());
        }
        if (!*more) {
            return finish(options);
        }
        if (is_gaze_ && !is_gaze_()) {
            first_left_out_ = left_out_++ == 0 ? table_.line() : first_left_out_;
            continue;
        }
        if (recording_column_ && is_of_another()) {
            continue;
        }
        TraceRow row;
        row.line = table_.line();
        for (const gaze::Eye eye : gaze::kEyes) {
            row.eyes[gaze::index(eye)] = eyes_[gaze::index(eye)].read(table_, bad_);
        }
        take_apart(row);
        row.not_understood = bad_.not_understood_at(row.line);
        any_valid_ = any_valid_ || row.eyes[0].valid || row.eyes[1].valid;
        builder_.add(row);
        if (++rows_ == kGuessedFrom) {
            make_room();
        }
    }
}

template <std::size_t Count>
std::optional<std::array<double, Count>> TraceRows::head(
    const std::array<std::size_t, Count>& columns) {
    std::array<double, Count> numbers{};
    std::size_t missing = 0;
    std::optional<std::size_t> unreadable;
    for (std::size_t i = 0; i < Count; ++i) {
        if (const std::optional<double> number = table_.real(columns[i])) {
            numbers[i] = *number;
        } else {
            missing += table_.is_missing(columns[i]) ? 1U : 0U;
            unreadable = unreadable.value_or(columns[i]);
        }
    }
    if (!unreadable) {
        bad_.has(RowDetail::Head);
        return numbers;
    }
    if (missing < Count) {
        refuse_head(*unreadable, "is no number");
    } else {
        bad_.lacks(RowDetail::Head, table_.line(), [&] { return table_.described(*unreadable); });
    }
    return std::nullopt;
}

}  // namespace gazeloop::drivers
