#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <stdexcept>
#include <string>
#include <string_view>

#include "runtime/gaze/eye.h"
#include "runtime/gaze/fovea_point.h"
#include "runtime/session/column_names.h"
#include "runtime/session/database.h"
#include "runtime/session/statement.h"

namespace gazeloop::session {

/// What is wrong with a file, with table and row. Does not leave this room.
class FormatError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// Whether the file has a real table of that name: a view or a virtual table of the same name could
/// hold anything, without end.
bool has_table(const Database& database, std::string_view table);

/// The rows of one table in the order of its key, checked field by field. Every member throws
/// FormatError.
class TableReader {
  public:
    /// The key is one integer column or two, given as "a" or "a, b". `version`: the file's schema.
    TableReader(const Database& database, std::string_view table, std::string_view key,
                const ColumnNames& columns, int version);

    /// Moves to the next row; false after the last one.
    bool next();

    /// Reads the row's next field (see record_fields.h).
    template <typename Field>
    void operator()(std::string_view, std::string_view, Field& field) {
        read(field);
        ++column_;
    }

    /// Whether the row's next field is NULL.
    [[nodiscard]] bool at_null() const;

    /// Reports the row.
    [[noreturn]] void fail(std::string_view what) const;

  private:
    using Key = std::array<std::int64_t, 2>;

    void read(std::int64_t& value);
    void read(std::uint64_t& value);
    void read(std::uint32_t& value);
    void read(bool& value);
    void read(double& value);
    void read(std::string& value);
    void read(time::StampKind& value);
    void read(gaze::FoveaState& value);
    void read(gaze::LossReason& value);
    void read(gaze::Eye& value);
    template <typename T>
    void read(std::optional<T>& value) {
        if (at_null()) {
            value.reset();
        } else {
            read(value.emplace());
        }
    }
    void read_key();
    [[nodiscard]] std::int64_t integer() const;
    [[nodiscard]] std::int64_t integer_below(std::int64_t end) const;
    [[noreturn]] void fail_field(std::string_view expected) const;

    std::string table_;
    int key_columns_;
    Statement statement_;
    std::optional<Key> key_;
    std::uint64_t row_ = 0;
    int column_ = 0;
};

}  // namespace gazeloop::session
