#pragma once

#include <filesystem>
#include <memory>

#include "runtime/error.h"
#include "runtime/session/session_info.h"

namespace gazeloop::session {

class Database;

/// A session file that is open for reading. Its recorder may have been killed, or may still be
/// writing. Everything that is read is as it was at the last commit before opening. Used by one
/// thread at a time.
class OpenSession {
  public:
    /// Reads what the session says of itself, and none of its frames. Errors (BadInput, each naming
    /// the file):
    ///  - missing;
    ///  - not a session;
    ///  - of a newer or too old schema (both versions named);
    ///  - damaged (table and row named).
    /// What a recording that was not closed lacks, because its log was not copied with it, is no
    /// error: info().missing_log says so.
    static Expected<OpenSession> open(const std::filesystem::path& file);
    OpenSession(const OpenSession&) = delete;
    OpenSession& operator=(const OpenSession&) = delete;
    OpenSession(OpenSession&&) noexcept;
    OpenSession& operator=(OpenSession&&) noexcept;
    ~OpenSession();

    [[nodiscard]] const SessionInfo& info() const { return info_; }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    /// For play() and the cursors, which read its tables.
    [[nodiscard]] const Database& database() const { return *database_; }

  private:
    OpenSession(std::filesystem::path file, std::unique_ptr<Database> database, SessionInfo info);

    std::filesystem::path file_;
    std::unique_ptr<Database> database_;
    SessionInfo info_;
};

/// Whether the file begins as SQLite files do; false too if it cannot be read.
bool looks_like_session(const std::filesystem::path& file);

}  // namespace gazeloop::session
