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

void Statement::bind_pointer(int parameter, void* pointer, const char* type) {
    check(sqlite3_bind_pointer(handle_.get(), parameter + 1, pointer, type, nullptr));
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

std::int64_t Statement::integer(int column) const {
    return sqlite3_column_int64(handle_.get(), column);
}

bool Statement::sorted() const {
    constexpr int kKeepCounting = 0;
    return sqlite3_stmt_status(handle_.get(), SQLITE_STMTSTATUS_SORT, kKeepCounting) > 0;
}

}  // namespace gazeloop::session
