#pragma once

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

#include "runtime/error.h"

namespace gazeloop::drivers {

/// A table of separated values with one header line, read row by row: the file may be of any size.
/// Cells are separated by whichever of ',', ';' and tab the header has most of; there are no
/// quotes. Lines end with LF or CRLF; blank lines are skipped; a UTF-8 byte order mark is ignored.
/// Numbers are written the C way, whatever the locale.
///
/// Every error is BadInput and says "NAME:LINE: ...". A cell that cannot be read gives 0, and the
/// following next() fails with the first such cell's error. So a reader can take a row apart
/// without checking every cell.
class CsvTable {
  public:
    /// The longest line that is read, in bytes without its end.
    static constexpr std::size_t kLongestLine = 65'536;

    /// Reads the header line. `in` must outlive the table; `name` stands in messages. Errors: an
    /// empty file, a line that is too long or not text, a column name that occurs twice.
    [[nodiscard]] static Expected<CsvTable> open(std::istream& in, std::string name);

    [[nodiscard]] const std::string& name() const { return name_; }

    /// Those of the columns that the header does not have.
    [[nodiscard]] std::vector<std::string_view> missing(
        std::span<const std::string_view> columns) const;

    /// Where a column stands. Precondition: the header has it.
    [[nodiscard]] std::size_t column(std::string_view column_name) const;

    /// Goes to the next row; false at the end. Errors: that of a cell of the row before, a line
    /// that is too long or not text, a row with more or fewer cells than the header.
    [[nodiscard]] Expected<bool> next();

    [[nodiscard]] bool blank(std::size_t column) const { return cells_[column].empty(); }

    /// A finite number.
    [[nodiscard]] double number(std::size_t column);
    /// A finite number, or `unknown` where the cell is blank.
    [[nodiscard]] double number_or(std::size_t column, double unknown);
    [[nodiscard]] std::int64_t integer(std::size_t column);
    [[nodiscard]] std::uint64_t count(std::size_t column);

    /// Says that a cell's value is not what the format allows: "column 'x': 'CELL' PROBLEM".
    void refuse(std::size_t column, std::string_view problem);

  private:
    CsvTable(std::istream& in, std::string name);

    /// Reads a line into text_ without its end; false at the end of the file.
    [[nodiscard]] Expected<bool> read_line();
    void split();
    [[nodiscard]] std::unexpected<Error> error_here(std::string_view message) const;

    std::istream* in_;
    std::string name_;
    std::vector<char> buffer_;  // never resized: cells_ and text_ point into it
    std::string_view text_;
    std::uint64_t line_ = 0;
    char separator_ = ',';
    std::vector<std::string> header_;
    std::map<std::string, std::size_t, std::less<>> column_of_;
    std::vector<std::string_view> cells_;
    std::optional<Error> refused_;
};

}  // namespace gazeloop::drivers
