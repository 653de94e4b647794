#include "runtime/session/reading_error.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <string>

#include "runtime/session/database.h"
#include "runtime/session/table_reader.h"
#include "runtime/session/write_ahead_log.h"

namespace gazeloop::session {

Error bad_session(const std::filesystem::path& file, std::string_view what) {
    return {ErrorKind::BadInput, fmt::format("{}: {}", file.string(), what)};
}

Error reading_error(const std::filesystem::path& file) {
    try {
        throw;
    } catch (const FormatError& format) {
        return bad_session(file, format.what());
    } catch (const DatabaseError& database) {
        const bool damaged = database.code() == SQLITE_CORRUPT || database.code() == SQLITE_NOTADB;
        const std::string lacks = missing_log(file);
        if (damaged && !lacks.empty()) {
            return bad_session(file, fmt::format("{}: {}", database.what(), lacks));
        }
        return bad_session(
            file, damaged ? fmt::format("{}: it is cut short or damaged", database.what())
                          : fmt::format("{}; if {}-wal exists, copy both into a folder that can be "
                                        "written to",
                                        database.what(), file.filename().string()));
    }
}

}  // namespace gazeloop::session
