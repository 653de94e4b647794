#include "runtime/session/open_session.h"

#include <fstream>
#include <string_view>
#include <system_error>
#include <utility>

#include "runtime/files/recording_file.h"
#include "runtime/session/database.h"
#include "runtime/session/info_reader.h"
#include "runtime/session/reading_error.h"
#include "runtime/session/statement.h"
#include "runtime/session/table_reader.h"
#include "runtime/session/write_ahead_log.h"

namespace gazeloop::session {
namespace {

/// SQLite fills up a last page that is cut off with zeros, which would pass for data.
void require_whole_pages(const Database& database, const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file, error);
    Statement page_size(database, "PRAGMA page_size");
    if (error || !page_size.next() ||
        bytes % static_cast<std::uintmax_t>(page_size.integer(0)) != 0) {
        throw FormatError("is cut off; copy it again");
    }
}

std::unexpected<Error> refused(const std::filesystem::path& file, std::string_view what) {
    return std::unexpected(bad_session(file, what));
}

}  // namespace

OpenSession::OpenSession(std::filesystem::path file, std::unique_ptr<Database> database,
                         SessionInfo info)
    : file_(std::move(file)), database_(std::move(database)), info_(std::move(info)) {}
OpenSession::OpenSession(OpenSession&&) noexcept = default;
OpenSession& OpenSession::operator=(OpenSession&&) noexcept = default;
OpenSession::~OpenSession() = default;

Expected<OpenSession> OpenSession::open(const std::filesystem::path& file) {
    std::error_code error;
    const std::filesystem::file_status status = std::filesystem::status(file, error);
    if (!std::filesystem::exists(status)) {
        return refused(file, "does not exist");
    }
    if (!std::filesystem::is_regular_file(status)) {
        return refused(file, "is not a file");
    }
    if (!std::ifstream(file)) {
        return refused(file, "cannot be opened for reading");
    }
    if (!looks_like_session(file)) {
        return refused(file, "is not a session: no SQLite file");
    }
    try {
        auto database = std::make_unique<Database>(file, Database::Access::ReadOnly);
        // One state of a file that is still being written, from its first read on.
        database->execute("BEGIN; SELECT 1 FROM sqlite_schema");
        const bool log = has_write_ahead_log(file);
        if (!log) {  // else the file itself may be unfinished
            require_whole_pages(*database, file);
        }
        SessionInfo info = read_info(*database);
        info.had_write_ahead_log = log;
        if (!info.closed_cleanly && !info.writing_failed) {
            info.missing_log = missing_log(file);
        }
        return OpenSession(file, std::move(database), std::move(info));
    } catch (...) {
        return std::unexpected(reading_error(file));
    }
}

bool looks_like_session(const std::filesystem::path& file) {
    return files::begins_as_recording(file);
}

}  // namespace gazeloop::session
