#include "runtime/session/table_reader.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <vector>

#include "runtime/session/schema.h"

namespace gazeloop::session {
namespace {

/// The name that a column of `frame` had in version 1; empty: there was none.
std::string_view former_name(std::string_view name) {
    const auto at = std::ranges::find(kFormerColumns, name, &FormerColumn::name);
    if (at != kFormerColumns.end()) {
        return at->before;
    }
    return name.starts_with("grid_") || name.starts_with("pass_") ? std::string_view{} : name;
}

/// What a column is read from in a file of this version: itself, a former name, or NULL where the
/// file lacks it.
std::string source_of(const Database& database, std::string_view table, std::string_view name,
                      int version) {
    const std::string_view before = version == 1 ? former_name(name) : name;
    const bool later = std::ranges::find(kLaterColumns, before) != kLaterColumns.end();
    const bool lacking = before.empty() || (later && !has_column(database, table, before));
    return std::string(lacking ? "NULL" : before);
}

/// The table's rows in the unsigned order of the key, which begins with the first of the columns:
/// one query after the other. SQLite's own order is that of signed numbers.
std::vector<RowStatement> select(const Database& database, std::string_view table,
                                 std::span<const std::string> columns, std::size_t key_columns,
                                 int version) {
    try {
        if (!has_table(database, table)) {
            throw FormatError(fmt::format("not a session: has no table {}", table));
        }
        std::vector<std::string> from;
        for (const std::string& name : columns) {
            from.push_back(source_of(database, table, name, version));
        }
        const std::string& key = columns.front();
        // A key of one column is another name of the row's number.
        const std::string order = fmt::format(
            "ORDER BY {}", key_columns == 1
                               ? "rowid"
                               : fmt::format("{}", fmt::join(columns.first(key_columns), ", ")));
        std::vector<RowStatement> parts;
        const std::string negative = fmt::format("FROM {} WHERE {} < 0", table, key);
        if (Statement(database, fmt::format("SELECT 1 {} LIMIT 1", negative)).next()) {
            parts.emplace_back(database, from,
                               fmt::format("FROM {} WHERE {} >= 0 {}", table, key, order));
            parts.emplace_back(database, from, fmt::format("{} {}", negative, order));
        } else {
            parts.emplace_back(database, from, fmt::format("FROM {} {}", table, order));
        }
        return parts;
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

bool has_column(const Database& database, std::string_view table, std::string_view column) {
    Statement find(database, "SELECT 1 FROM pragma_table_info(?) WHERE name = ?");
    find.bind(0, table);
    find.bind(1, column);
    return find.next();
}

TableReader::TableReader(const Database& database, std::string_view table,
                         std::span<const std::string_view> key, const ColumnNames& columns,
                         int version)
    : table_(table), key_columns_(key.size()), columns_(key.begin(), key.end()) {
    columns_.insert(columns_.end(), columns.names().begin(), columns.names().end());
    parts_ = select(database, table, columns_, key_columns_, version);
}

bool TableReader::next() {
    ++row_;
    column_ = 0;
    if (!step()) {
        return false;
    }
    if (row_ == 1 && parts_[part_].sorted()) {
        fail("is not stored by its key");
    }
    read_key();
    return true;
}

bool TableReader::step() {
    try {
        while (part_ < parts_.size() && !parts_[part_].next()) {
            ++part_;
        }
    } catch (const DatabaseError& error) {
        fail(error.what());
    }
    return part_ < parts_.size();
}

void TableReader::read_key() {
    Key key{};
    for (; column_ < key_columns_; ++column_) {
        read(cell(), key[column_]);
    }
    // A damaged tree may lead to the same rows again and again.
    if (key_ && key <= *key_) {
        fail("is out of order, the table is damaged");
    }
    key_ = key;
}

void TableReader::fail(std::string_view what) const {
    throw FormatError(fmt::format("table {}, row {}: {}", table_, row_, what));
}

void TableReader::fail_field(std::string_view expected) const {
    fail(fmt::format("column {} holds {} where {} was expected", columns_[column_], cell().shown(),
                     expected));
}

void TableReader::fail_range(std::int64_t end) const {
    fail_field(fmt::format("an integer from 0 to {}", end - 1));
}

}  // namespace gazeloop::session
