#include "runtime/session/table_reader.h"

#include <fmt/format.h>

#include <algorithm>
#include <bit>
#include <limits>
#include <vector>

#include "runtime/session/schema.h"

namespace gazeloop::session {
namespace {

bool has_column(const Database& database, std::string_view table, std::string_view column) {
    Statement find(database, "SELECT 1 FROM pragma_table_info(?) WHERE name = ?");
    find.bind(0, table);
    find.bind(1, column);
    return find.next();
}

/// The name that a column of `frame` had in version 1; empty: there was none.
std::string_view former_name(std::string_view name) {
    const auto at = std::ranges::find(kFormerColumns, name, &FormerColumn::name);
    if (at != kFormerColumns.end()) {
        return at->before;
    }
    return name.starts_with("grid_") || name.starts_with("pass_") ? std::string_view{} : name;
}

/// What is read from elsewhere in a file of this version: former names, and NULL for columns that
/// it lacks.
std::vector<ColumnSource> sources(const Database& database, std::string_view table,
                                  const ColumnNames& columns, int version) {
    std::vector<ColumnSource> sources;
    for (const std::string& name : columns.names()) {
        const std::string_view before = version == 1 ? former_name(name) : name;
        const bool later = std::ranges::find(kLaterColumns, before) != kLaterColumns.end();
        if (before.empty() || (later && !has_column(database, table, before))) {
            sources.push_back({name, "NULL"});
        } else if (before != name) {
            sources.push_back({name, std::string(before)});
        }
    }
    return sources;
}

Statement select(const Database& database, std::string_view table, std::string_view key,
                 const ColumnNames& columns, int version) {
    try {
        if (!has_table(database, table)) {
            throw FormatError(fmt::format("not a session: has no table {}", table));
        }
        return {database,
                columns.select_from(table, key, sources(database, table, columns, version))};
    } catch (const DatabaseError& error) {
        throw FormatError(fmt::format("table {}: {}", table, error.what()));
    }
}

}  // namespace

bool has_table(const Database& database, std::string_view table) {
    Statement find(
        database, "SELECT 1 FROM sqlite_schema WHERE type = 'table' AND rootpage > 0 AND name = ?");
    find.bind(0, table);
    return find.next();
}

TableReader::TableReader(const Database& database, std::string_view table, std::string_view key,
                         const ColumnNames& columns, int version)
    : table_(table),
      key_columns_(1 + static_cast<int>(std::count(key.begin(), key.end(), ','))),
      statement_(select(database, table, key, columns, version)) {}

bool TableReader::next() {
    ++row_;
    column_ = 0;
    try {
        if (!statement_.next()) {
            return false;
        }
    } catch (const DatabaseError& error) {
        fail(error.what());
    }
    read_key();
    return true;
}

void TableReader::read_key() {
    Key key{};
    for (; column_ < key_columns_; ++column_) {
        key[static_cast<std::size_t>(column_)] = integer();
    }
    // A damaged tree may lead to the same rows again and again.
    if (key_ && key <= *key_) {
        fail("is out of order, the table is damaged");
    }
    key_ = key;
}

bool TableReader::at_null() const { return statement_.type(column_) == Statement::Type::Null; }

void TableReader::fail(std::string_view what) const {
    throw FormatError(fmt::format("table {}, row {}: {}", table_, row_, what));
}

void TableReader::fail_field(std::string_view expected) const {
    constexpr std::size_t kShown = 40;
    const std::string_view text = statement_.text(column_);
    fail(fmt::format("column {} holds {} where {} was expected", statement_.name(column_),
                     at_null() ? "NULL" : fmt::format("'{}'", text.substr(0, kShown)), expected));
}

std::int64_t TableReader::integer() const {
    if (statement_.type(column_) != Statement::Type::Integer) {
        fail_field("an integer");
    }
    return statement_.integer(column_);
}

std::int64_t TableReader::integer_below(std::int64_t end) const {
    const std::int64_t value = integer();
    if (value < 0 || value >= end) {
        fail_field(fmt::format("an integer from 0 to {}", end - 1));
    }
    return value;
}

void TableReader::read(std::int64_t& value) { value = integer(); }

void TableReader::read(std::uint64_t& value) { value = std::bit_cast<std::uint64_t>(integer()); }

void TableReader::read(std::uint32_t& value) {
    constexpr std::int64_t kEnd = std::int64_t{std::numeric_limits<std::uint32_t>::max()} + 1;
    value = static_cast<std::uint32_t>(integer_below(kEnd));
}

void TableReader::read(bool& value) { value = integer_below(2) == 1; }

void TableReader::read(double& value) {
    if (at_null()) {
        value = std::numeric_limits<double>::quiet_NaN();
        return;
    }
    if (statement_.type(column_) != Statement::Type::Real) {
        fail_field("a real number or NULL");
    }
    value = statement_.real(column_);
}

void TableReader::read(std::string& value) {
    if (statement_.type(column_) != Statement::Type::Text) {
        fail_field("text");
    }
    value = statement_.text(column_);
}

void TableReader::read(time::StampKind& value) {
    value = static_cast<time::StampKind>(
        integer_below(static_cast<std::int64_t>(time::kStampKindCount)));
}

void TableReader::read(gaze::FoveaState& value) {
    value = static_cast<gaze::FoveaState>(
        integer_below(static_cast<std::int64_t>(gaze::kFoveaStateNames.size())));
}

void TableReader::read(gaze::LossReason& value) {
    value = static_cast<gaze::LossReason>(
        integer_below(static_cast<std::int64_t>(gaze::kLossReasonNames.size())));
}

void TableReader::read(gaze::Eye& value) {
    value = static_cast<gaze::Eye>(integer_below(static_cast<std::int64_t>(gaze::kEyeCount)));
}

}  // namespace gazeloop::session
