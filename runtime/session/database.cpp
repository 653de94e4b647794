#include "runtime/session/database.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <string>
#include <system_error>

#include "runtime/session/row_statement.h"

namespace gazeloop::session {
namespace {

constexpr int kBusyTimeoutMs = 1000;
constexpr int kLongestValueBytes = 16 * 1024 * 1024;

int primary_code(sqlite3* database) { return sqlite3_errcode(database) & 0xFF; }

/// "disk I/O error" and its like say little without SQLite's extended code and the system's error.
std::string describe(sqlite3* database) {
    std::string text = sqlite3_errmsg(database);
    const int code = primary_code(database);
    if (code == SQLITE_IOERR || code == SQLITE_CANTOPEN) {
        text += fmt::format(" (SQLite code {}", sqlite3_extended_errcode(database));
        const int system = sqlite3_system_errno(database);
        text += system == 0 ? ")" : ", " + std::generic_category().message(system) + ")";
    }
    return text;
}

}  // namespace

DatabaseError::DatabaseError(sqlite3* database)
    : std::runtime_error(describe(database)), code_(primary_code(database)) {}

void Database::Close::operator()(sqlite3* database) const { sqlite3_close_v2(database); }

Database::Database(const std::filesystem::path& file, Access access) {
    // An absolute name, so that SQLite never takes it for a special one (":memory:", "").
    const std::string name = std::filesystem::absolute(file).string();
    const int flags = SQLITE_OPEN_NOMUTEX | SQLITE_OPEN_EXRESCODE |
                      (access == Access::ReadOnly ? SQLITE_OPEN_READONLY : SQLITE_OPEN_READWRITE);
    sqlite3* opened = nullptr;
    const int result = sqlite3_open_v2(name.c_str(), &opened, flags, nullptr);
    handle_.reset(opened);
    if (result != SQLITE_OK) {
        throw DatabaseError(opened);
    }
    sqlite3_busy_timeout(opened, kBusyTimeoutMs);
    if (access == Access::ReadOnly) {
        // The file may come from anybody: run no functions from its schema, build no huge values.
        sqlite3_db_config(opened, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
        sqlite3_db_config(opened, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
        sqlite3_limit(opened, SQLITE_LIMIT_LENGTH, kLongestValueBytes);
        add_row_function(opened);
    }
}

void Database::execute(const char* sql) {
    if (sqlite3_exec(handle(), sql, nullptr, nullptr, nullptr) != SQLITE_OK) {
        throw DatabaseError(handle());
    }
}

void Database::roll_back() {
    if (sqlite3_get_autocommit(handle()) == 0) {
        execute("ROLLBACK");
    }
}

bool Database::moved() const {
    int moved = 0;
    sqlite3_file_control(handle(), "main", SQLITE_FCNTL_HAS_MOVED, &moved);
    return moved != 0;
}

}  // namespace gazeloop::session
