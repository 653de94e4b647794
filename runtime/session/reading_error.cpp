#include "runtime/session/reading_error.h"

#include <fmt/format.h>
#include <sqlite3.h>

#include <string>

#include "runtime/session/database.h"
#include "runtime/session/table_reader.h"
#include "runtime/session/write_ahead_log.h"

namespace gazeloop::session {

namespace {

/// What a damaged file says may end up in a message, and that on a terminal: nothing but text, and
/// not much of it.
std::string printable(std::string_view text) {
    constexpr std::size_t kMost = 400;
    std::string shown;
    for (const char c : text.substr(0, kMost)) {
        const bool plain = c >= ' ' && c <= '~';
        shown +=
            plain ? std::string(1, c)
                  : fmt::format("\\x{:02x}", static_cast<unsigned>(static_cast<unsigned char>(c)));
    }
    return text.size() > kMost ? shown + "..." : shown;
}

}  // namespace

Error bad_session(const std::filesystem::path& file, std::string_view what) {
    return {ErrorKind::BadInput, fmt::format("{}: {}", file.string(), what)};
}

Error reading_error(const std::filesystem::path& file) {
    try {
        throw;
    } catch (const FormatError& format) {
        return bad_session(file, printable(format.what()));
    } catch (const DatabaseError& database) {
        const bool damaged = database.code() == SQLITE_CORRUPT || database.code() == SQLITE_NOTADB;
        const std::string lacks = missing_log(file);
        const std::string what = printable(database.what());
        if (damaged && !lacks.empty()) {
            return bad_session(file, fmt::format("{}: {}", what, lacks));
        }
        return bad_session(
            file, damaged ? fmt::format("{}: it is cut short or damaged", what)
                          : fmt::format("{}; if {}-wal exists, copy both into a folder that can be "
                                        "written to",
                                        what, file.filename().string()));
    }
}

}  // namespace gazeloop::session
