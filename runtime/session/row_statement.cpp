#include "runtime/session/row_statement.h"

#include <fmt/format.h>
#include <fmt/ranges.h>
#include <sqlite3.h>

#include <exception>

namespace gazeloop::session {
namespace {

constexpr const char* kFunction = "gazeloop_copy_row";
constexpr const char* kCells = "gazeloop cells";  // the type of its first argument

std::string_view bytes_of(sqlite3_value* value) {
    const auto* bytes = static_cast<const char*>(sqlite3_value_blob(value));
    const int size = sqlite3_value_bytes(value);
    return bytes == nullptr ? std::string_view{}
                            : std::string_view{bytes, static_cast<std::size_t>(size)};
}

void copy(sqlite3_value* value, Cell& cell) {
    switch (sqlite3_value_type(value)) {
        case SQLITE_INTEGER:
            cell.set(std::int64_t{sqlite3_value_int64(value)});
            break;
        case SQLITE_FLOAT:
            cell.set(sqlite3_value_double(value));
            break;
        case SQLITE_TEXT:
            cell.set(Cell::Type::Text, bytes_of(value));
            break;
        case SQLITE_BLOB:
            cell.set(Cell::Type::Blob, bytes_of(value));
            break;
        default:
            cell.set_null();
            break;
    }
}

/// gazeloop_copy_row(cells, column, ...): returns nothing of interest.
void copy_row(sqlite3_context* context, int count, sqlite3_value** values) {
    auto* const cells = static_cast<std::vector<Cell>*>(sqlite3_value_pointer(values[0], kCells));
    const std::span columns(values + 1, static_cast<std::size_t>(count - 1));
    if (cells == nullptr || columns.size() != cells->size()) {
        sqlite3_result_error(context, "called by a stranger", -1);
        return;
    }
    try {
        for (std::size_t i = 0; i < columns.size(); ++i) {
            copy(columns[i], (*cells)[i]);
        }
    } catch (const std::exception&) {  // nothing passes through SQLite
        sqlite3_result_error_nomem(context);
    }
}

std::string query(std::span<const std::string> columns, std::string_view from) {
    return fmt::format("SELECT {}(?, {}) {}", kFunction, fmt::join(columns, ", "), from);
}

}  // namespace

std::string Cell::shown() const {
    constexpr std::size_t kShown = 40;
    switch (type_) {
        case Type::Null:
            return "NULL";
        case Type::Integer:
            return fmt::format("'{}'", integer());
        case Type::Real:
            return fmt::format("'{}'", real());
        default:
            return fmt::format("'{}'", std::string_view(bytes_).substr(0, kShown));
    }
}

void add_row_function(sqlite3* database) {
    constexpr int kAnyNumber = -1;
    if (sqlite3_create_function_v2(database, kFunction, kAnyNumber, SQLITE_UTF8 | SQLITE_DIRECTONLY,
                                   nullptr, copy_row, nullptr, nullptr, nullptr) != SQLITE_OK) {
        throw DatabaseError(database);
    }
}

RowStatement::RowStatement(const Database& database, std::span<const std::string> columns,
                           std::string_view from)
    : cells_(std::make_unique<std::vector<Cell>>(columns.size())),
      statement_(database, query(columns, from)) {
    statement_.bind_pointer(0, cells_.get(), kCells);
}

}  // namespace gazeloop::session
