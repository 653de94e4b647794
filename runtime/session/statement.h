#pragma once

#include <cstdint>
#include <memory>
#include <string_view>

#include "runtime/session/database.h"

struct sqlite3_stmt;

namespace gazeloop::session {

/// A prepared statement. Parameters and columns are numbered from 0. Members that can fail throw
/// DatabaseError.
class Statement {
  public:
    Statement(const Database& database, std::string_view sql);

    void bind_null(int parameter);
    void bind(int parameter, std::int64_t value);
    void bind(int parameter, double value);           ///< not-a-number becomes NULL
    void bind(int parameter, std::string_view text);  ///< must live until the statement has run

    /// For an SQL function of our own that knows the type's name. Both arguments must outlive the
    /// statement.
    void bind_pointer(int parameter, void* pointer, const char* type);

    /// Runs a statement that returns no rows, and makes it ready for the next run.
    void run();

    /// Moves to the next row; false after the last one.
    bool next();

    [[nodiscard]] std::int64_t integer(int column) const;
    [[nodiscard]] bool sorted() const;  ///< SQLite has sorted rows for it

  private:
    struct Finalize {
        void operator()(sqlite3_stmt* statement) const;
    };
    void check(int result) const;

    sqlite3* database_;
    std::unique_ptr<sqlite3_stmt, Finalize> handle_;
};

}  // namespace gazeloop::session
