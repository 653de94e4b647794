#pragma once

#include <cstddef>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace gazeloop::drivers {

/// A line of separated values taken apart into its cells, without the spaces around them. A cell
/// may stand in double quotes: separators in it are text, and "" is a quote.
class LineCells {
  public:
    enum class Problem { None, OpenQuote, TextBehindQuote };

    /// `longest_line`: of the lines that will be split, bytes.
    explicit LineCells(std::size_t longest_line) { unquoted_.reserve(longest_line); }

    /// Takes `line` apart; the cells hold until the next line, and as long as `line` does. With a
    /// problem, only those before the cell that has it.
    [[nodiscard]] Problem split(std::string_view line, char separator);

    [[nodiscard]] std::span<const std::string_view> cells() const { return cells_; }
    [[nodiscard]] std::string_view operator[](std::size_t column) const { return cells_[column]; }
    [[nodiscard]] std::size_t size() const { return cells_.size(); }
    [[nodiscard]] bool had_quotes() const { return had_quotes_; }

    /// Leaves out the last cell.
    void drop_last() { cells_.pop_back(); }

  private:
    [[nodiscard]] Problem split_quoted(std::string_view line, char separator);

    std::vector<std::string_view> cells_;
    std::string unquoted_;  ///< what stood in quotes; never longer than a line, so that it stays
    bool had_quotes_ = false;
};

/// Without spaces and tabs at both ends.
[[nodiscard]] std::string_view trimmed(std::string_view text);

/// How often `c` stands in the line outside quotes.
[[nodiscard]] std::size_t count_outside_quotes(std::string_view line, char c);

}  // namespace gazeloop::drivers
