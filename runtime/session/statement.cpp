#include "runtime/session/statement.h"

#include <sqlite3.h>

namespace gazeloop::session {

Statement::Statement(const Database& database, std::string_view sql)
    : database_(database.handle()) {
    sqlite3_stmt* prepared = nullptr;
    check(sqlite3_prepare_v3(database_, sql.data(), static_cast<int>(sql.size()),
                             SQLITE_PREPARE_PERSISTENT, &prepared, nullptr));
    handle_.reset(prepared);
}

void Statement::Finalize::operator()(sqlite3_stmt* statement) const { sqlite3_finalize(statement); }

void Statement::check(int result) const {
    if (result != SQLITE_OK) {
        throw DatabaseError(database_);
    }
}

void Statement::bind_null(int parameter) { check(sqlite3_bind_null(handle_.get(), parameter + 1)); }

void Statement::bind(int parameter, std::int64_t value) {
    check(sqlite3_bind_int64(handle_.get(), parameter + 1, value));
}

void Statement::bind(int parameter, double value) {
    check(sqlite3_bind_double(handle_.get(), parameter + 1, value));
}

void Statement::bind(int parameter, std::string_view text) {
    const char* bytes = text.empty() ? "" : text.data();  // a null pointer would be bound as NULL
    check(sqlite3_bind_text64(handle_.get(), parameter + 1, bytes, text.size(), SQLITE_STATIC,
                              SQLITE_UTF8));
}

void Statement::run() {
    while (next()) {
    }
    check(sqlite3_reset(handle_.get()));
}

bool Statement::next() {
    const int result = sqlite3_step(handle_.get());
    if (result != SQLITE_ROW && result != SQLITE_DONE) {
        throw DatabaseError(database_);
    }
    return result == SQLITE_ROW;
}

Statement::Type Statement::type(int column) const {
    switch (sqlite3_column_type(handle_.get(), column)) {
        case SQLITE_INTEGER:
            return Type::Integer;
        case SQLITE_FLOAT:
            return Type::Real;
        case SQLITE_TEXT:
            return Type::Text;
        case SQLITE_BLOB:
            return Type::Blob;
        default:
            return Type::Null;
    }
}

std::int64_t Statement::integer(int column) const {
    return sqlite3_column_int64(handle_.get(), column);
}

double Statement::real(int column) const { return sqlite3_column_double(handle_.get(), column); }

std::string_view Statement::text(int column) const {
    const auto* bytes = reinterpret_cast<const char*>(sqlite3_column_text(handle_.get(), column));
    const int size = sqlite3_column_bytes(handle_.get(), column);
    return bytes == nullptr ? std::string_view{}
                            : std::string_view{bytes, static_cast<std::size_t>(size)};
}

std::string_view Statement::name(int column) const {
    return sqlite3_column_name(handle_.get(), column);
}

}  // namespace gazeloop::session
