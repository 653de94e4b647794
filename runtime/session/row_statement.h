#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/session/statement.h"

namespace gazeloop::session {

/// One value of a row, copied.
class Cell {
  public:
    enum class Type : std::uint8_t { Null, Integer, Real, Text, Blob };

    void set_null() { type_ = Type::Null; }
    void set(std::int64_t value) {
        type_ = Type::Integer;
        bits_ = value;
    }
    void set(double value) {
        type_ = Type::Real;
        bits_ = std::bit_cast<std::int64_t>(value);
    }
    void set(Type type, std::string_view bytes) {
        type_ = type;
        bytes_ = bytes;
    }

    [[nodiscard]] Type type() const { return type_; }
    [[nodiscard]] bool is_null() const { return type_ == Type::Null; }
    /// Preconditions: of that type.
    [[nodiscard]] std::int64_t integer() const { return bits_; }
    [[nodiscard]] double real() const { return std::bit_cast<double>(bits_); }
    [[nodiscard]] const std::string& text() const { return bytes_; }

    /// For a message, whatever the type: "NULL", else in quotes.
    [[nodiscard]] std::string shown() const;

  private:
    Type type_ = Type::Null;
    std::int64_t bits_ = 0;
    std::string bytes_;
};

/// Registers the SQL function that copies a row. Only our own statements may call it, no schema.
void add_row_function(sqlite3* database);

/// Rows of one query. All columns of a row are copied at once, because SQLite's own access, column
/// by column, takes longer than the rest of the reading. Members throw DatabaseError.
class RowStatement {
  public:
    /// Reads these columns or expressions; `from` is the rest of the query, from FROM on. SQLite
    /// takes 126 columns.
    RowStatement(const Database& database, std::span<const std::string> columns,
                 std::string_view from);

    /// Moves to the next row; false after the last one.
    bool next() { return statement_.next(); }

    /// Whether SQLite has had to sort the rows; known from the first row on. If so, all rows were
    /// copied before the first one came, and the cells are not the current row's.
    [[nodiscard]] bool sorted() const { return statement_.sorted(); }

    /// Of the current row, numbered from 0.
    [[nodiscard]] const Cell& cell(std::size_t column) const { return (*cells_)[column]; }

  private:
    std::unique_ptr<std::vector<Cell>>
        cells_;  ///< on the heap, so that a move of this does not move them
    Statement statement_;
};

}  // namespace gazeloop::session
