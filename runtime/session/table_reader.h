#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/frame/frame_gaze.h"
#include "runtime/gaze/eye.h"
#include "runtime/gaze/fovea_point.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/session/column_names.h"
#include "runtime/session/database.h"
#include "runtime/session/row_statement.h"

namespace gazeloop::session {

/// What is wrong with a file: names the table and the row. Does not leave this room.
class FormatError : public std::runtime_error {
  public:
    using std::runtime_error::runtime_error;
};

/// The key columns, which give the order in which tables are read.
inline constexpr std::array<std::string_view, 1> kByPosition{"position"};
inline constexpr std::array<std::string_view, 1> kByNumber{"number"};
inline constexpr std::array<std::string_view, 2> kByFrameAndEye{"frame", "eye"};

/// Whether the file has a real table of that name. A view or a virtual table could return anything,
/// without end.
bool has_table(const Database& database, std::string_view table);

bool has_column(const Database& database, std::string_view table, std::string_view column);

/// The rows of one table, checked field by field, in the order of its key: one unsigned number or
/// two. Every member throws FormatError.
class TableReader {
  public:
    /// The key is one integer column or two. `version`: the file's schema.
    TableReader(const Database& database, std::string_view table,
                std::span<const std::string_view> key, const ColumnNames& columns, int version);

    /// Moves to the next row; false after the last one, for good.
    bool next();

    /// Reads the row's next field (see record_fields.h).
    template <typename Field>
    void operator()(std::string_view, std::string_view, Field& field) {
        read(cell(), field);
        ++column_;
    }

    /// Passes over so many of the row's fields.
    void leave_out(std::size_t fields) { column_ += fields; }

    /// Whether the row's next field is NULL.
    [[nodiscard]] bool at_null() const { return cell().is_null(); }

    /// Throws the FormatError that names the row.
    [[noreturn]] void fail(std::string_view what) const;

  private:
    using Key = std::array<std::uint64_t, 2>;

    // Here, because every field of every row goes through them.
    void read(const Cell& cell, std::int64_t& value) const { value = integer(cell); }
    void read(const Cell& cell, std::uint64_t& value) const {
        value = std::bit_cast<std::uint64_t>(integer(cell));
    }
    void read(const Cell& cell, std::uint32_t& value) const {
        constexpr std::int64_t kEnd = std::int64_t{std::numeric_limits<std::uint32_t>::max()} + 1;
        value = static_cast<std::uint32_t>(integer_below(cell, kEnd));
    }
    void read(const Cell& cell, bool& value) const { value = integer_below(cell, 2) == 1; }
    void read(const Cell& cell, double& value) const {
        if (cell.type() == Cell::Type::Real) {
            value = cell.real();
        } else if (cell.is_null()) {
            value = std::numeric_limits<double>::quiet_NaN();
        } else {
            fail_field("a real number or NULL");
        }
    }
    void read(const Cell& cell, std::string& value) const {
        if (cell.type() != Cell::Type::Text) {
            fail_field("text");
        }
        value = cell.text();
    }
    void read(const Cell& cell, time::StampKind& value) const {
        read_name<time::kStampKindCount>(cell, value);
    }
    void read(const Cell& cell, gaze::FoveaState& value) const {
        read_name<gaze::kFoveaStateNames.size()>(cell, value);
    }
    void read(const Cell& cell, frame::GazeErrorGap& value) const {
        read_name<frame::kGazeErrorGapCount>(cell, value);
    }
    void read(const Cell& cell, gaze::EyeEvent& value) const {
        constexpr std::int64_t kEnd = gaze::kEyeEventNames.size() + 1;
        const std::int64_t number = integer_below(cell, kEnd);
        if (number == 0) {
            fail_field("an integer from 1 to 5");
        }
        value = static_cast<gaze::EyeEvent>(number);
    }
    void read(const Cell& cell, gaze::LossReason& value) const {
        read_name<gaze::kLossReasonNames.size()>(cell, value);
    }
    void read(const Cell& cell, gaze::LossCause& value) const {
        read_name<gaze::kLossCauseNames.size()>(cell, value);
    }
    void read(const Cell& cell, gaze::GazeProcessing& value) const {
        read_name<gaze::kGazeProcessingNames.size()>(cell, value);
    }
    void read(const Cell& cell, gaze::Eye& value) const { read_name<gaze::kEyeCount>(cell, value); }
    template <typename T>
    void read(const Cell& cell, std::optional<T>& value) const {
        if (cell.is_null()) {
            value.reset();
        } else {
            read(cell, value.emplace());
        }
    }
    template <std::size_t Count, typename Enum>
    void read_name(const Cell& cell, Enum& value) const {
        value = static_cast<Enum>(integer_below(cell, static_cast<std::int64_t>(Count)));
    }
    [[nodiscard]] std::int64_t integer(const Cell& cell) const {
        if (cell.type() != Cell::Type::Integer) {
            fail_field("an integer");
        }
        return cell.integer();
    }
    [[nodiscard]] std::int64_t integer_below(const Cell& cell, std::int64_t end) const {
        const std::int64_t value = integer(cell);
        if (value < 0 || value >= end) {
            fail_range(end);
        }
        return value;
    }
    [[nodiscard]] const Cell& cell() const { return parts_[part_].cell(column_); }
    [[nodiscard]] bool step();
    void read_key();
    [[noreturn]] void fail_field(std::string_view expected) const;
    [[noreturn]] void fail_range(std::int64_t end) const;

    std::string table_;
    std::size_t key_columns_;
    std::vector<std::string> columns_;  ///< the key's, then the record's
    std::vector<RowStatement> parts_;   ///< one after the other
    std::size_t part_ = 0;
    std::optional<Key> key_;
    std::uint64_t row_ = 0;
    std::size_t column_ = 0;
};

}  // namespace gazeloop::session
