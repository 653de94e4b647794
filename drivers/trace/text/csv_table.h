#pragma once

#include <array>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <istream>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "drivers/trace/text/cell_number.h"
#include "drivers/trace/text/line_cells.h"
#include "drivers/trace/text/text_lines.h"
#include "runtime/error.h"
#include "runtime/gaze/trace_report.h"

namespace gazeloop::drivers {

/// A table of separated values with one header line, read row by row: the file may be of any size,
/// and gzip (text_lines.h). Cells are separated by whichever of ',', ';', tab and '|' the header
/// has most of, or by what a line "sep=;" before it says; they may stand in double quotes. Blank
/// lines, and lines with '#', '//' or a single cell (a title) before the header, are skipped.
/// Column names are known in any case; a name asked for with " [*]" at its end is known by any unit
/// behind it, "Time [ms]" or "Time (ms)", or without one. Numbers are written with a decimal point,
/// or with a comma where that separates no cells, whatever the locale.
///
/// Every error is BadInput and says "NAME:LINE: what, and what to do". What was read although it is
/// not usual is noted (report_to). No cell is an error: what to make of a cell that holds no number
/// is for who asks for it.
class CsvTable {
  public:
    /// The longest line that is read, in bytes without its end.
    static constexpr std::size_t kLongestLine = TextLines::kLongestLine;

    /// Reads the header line. `in` must outlive the table; `name` stands in messages. Errors: an
    /// empty file, those of TextLines, a column name that occurs twice, quotes that do not close.
    [[nodiscard]] static Expected<CsvTable> open(std::istream& in, std::string name);
    /// The same of lines of which none, or the first alone, was read and held.
    [[nodiscard]] static Expected<CsvTable> open(TextLines lines);
    /// A table without a header line, whose columns are known from elsewhere. Errors: a name that
    /// occurs twice.
    [[nodiscard]] static Expected<CsvTable> without_header(TextLines lines, char separator,
                                                           std::span<const std::string> columns);

    [[nodiscard]] const std::string& name() const { return lines_.name(); }
    [[nodiscard]] std::uint64_t header_line() const { return header_line_; }
    [[nodiscard]] std::uint64_t line() const { return lines_.line(); }  ///< of the current row

    /// Whether the header has a column; one of this name in another case counts, where it is one.
    [[nodiscard]] bool has(std::string_view column_name) const;
    /// Those of the columns that the header does not have.
    [[nodiscard]] std::vector<std::string_view> missing(
        std::span<const std::string_view> columns) const;

    /// Where a column stands; none where the header does not have it.
    [[nodiscard]] std::optional<std::size_t> column(std::string_view column_name);

    /// Where columns that are of use only together stand. None where one of them is missing, which
    /// is noted as `what` if another is there.
    template <std::size_t Count>
    [[nodiscard]] std::optional<std::array<std::size_t, Count>> columns(
        const std::array<std::string_view, Count>& names, std::string_view what);

    /// Goes to the next row; false at the end. A last line without a line end that has fewer cells
    /// than the header was cut short: it is noted and not a row. Errors: those of TextLines, a row
    /// with more or fewer cells than the header, quotes that do not close.
    [[nodiscard]] Expected<bool> next();

    /// As TextLines::lines_ahead.
    [[nodiscard]] std::optional<std::uint64_t> rows_ahead() { return lines_.lines_ahead(); }

    /// A finite number; none where the cell holds none.
    [[nodiscard]] std::optional<double> real(std::size_t column) {
        NumberSpelling seen;
        const double value = real_or_nan(cells_[column], seen);
        if (seen.decimal_comma || seen.minus_sign) {
            note(seen);
        }
        return std::isnan(value) ? std::nullopt : std::optional(value);
    }
    [[nodiscard]] std::optional<std::int64_t> whole(std::size_t column);
    [[nodiscard]] std::optional<std::uint64_t> count(std::size_t column);
    /// In units of the `digits`th decimal: seconds as nanoseconds (9).
    [[nodiscard]] std::optional<std::int64_t> decimal(std::size_t column, int digits);
    /// Yes or no (truth_of); words in place of 1 and 0 are noted.
    [[nodiscard]] std::optional<bool> truth(std::size_t column);
    /// The cell itself, until the next row.
    [[nodiscard]] std::string_view text(std::size_t column) const { return cells_[column]; }
    /// What stands in brackets or parentheses behind a column's name; empty where nothing does.
    [[nodiscard]] std::string_view unit(std::size_t column) const;
    /// Whether the cell is blank or says in words that there is no number (cell_number.h).
    [[nodiscard]] bool is_missing(std::size_t column) const {
        return says_no_number(cells_[column]);
    }

    /// The column's name, as the header has it.
    [[nodiscard]] const std::string& name_of(std::size_t column) const { return header_[column]; }
    /// The cell as a message may quote it, "'abc'", and with its column: "column 'x': 'abc'".
    [[nodiscard]] std::string quoted(std::size_t column) const;
    [[nodiscard]] std::string described(std::size_t column) const;

    /// Notes something that was read although it is not usual, or was not read.
    void note(std::uint64_t line, std::string text,
              gaze::TraceFindingKind kind = gaze::TraceFindingKind::Text);
    /// Adds what was noted, and a last line that was cut.
    void report_to(gaze::TraceReport& report) const;

  private:
    explicit CsvTable(TextLines lines);

    /// Goes to the header's line.
    [[nodiscard]] Expected<void> skip_preamble();
    [[nodiscard]] Expected<void> read_header();
    [[nodiscard]] Expected<void> take_header(std::span<const std::string_view> names);
    /// Whether the line says what separates; takes it over.
    [[nodiscard]] Expected<bool> takes_separator(std::string_view line);
    /// Rows may all end with a separator that the header's end does not have, or the reverse.
    void take_width_from_first_row();
    [[nodiscard]] std::size_t find(std::string_view column_name) const;
    void note_missing(std::span<const std::string_view> names, std::string_view what);
    void note(const NumberSpelling& seen);

    TextLines lines_;
    char separator_ = '\0';  ///< not known yet
    std::uint64_t header_line_ = 0;
    std::vector<std::string> header_;
    std::map<std::string, std::size_t, std::less<>> column_of_;
    std::map<std::string, std::size_t, std::less<>> column_of_lower_case_;
    std::map<std::string, std::size_t, std::less<>> column_of_unitless_;  ///< in lower case
    LineCells cells_{kLongestLine};
    std::size_t width_ = 0;  ///< of each row; 0: no row yet
    std::vector<gaze::TraceFinding> notes_;
    std::vector<std::string> in_other_case_;  ///< as the header has them
    NumberSpelling seen_;
    bool seen_truth_in_words_ = false;
    bool seen_quotes_ = false;
    std::uint64_t cut_line_ = 0;  ///< 0: none
};

template <std::size_t Count>
std::optional<std::array<std::size_t, Count>> CsvTable::columns(
    const std::array<std::string_view, Count>& names, std::string_view what) {
    std::array<std::size_t, Count> found{};
    for (std::size_t i = 0; i < Count; ++i) {
        const std::optional<std::size_t> at = column(names[i]);
        if (!at) {
            note_missing(names, what);
            return std::nullopt;
        }
        found[i] = *at;
    }
    return found;
}

}  // namespace gazeloop::drivers
