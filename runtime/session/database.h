#pragma once

#include <filesystem>
#include <memory>
#include <stdexcept>

struct sqlite3;

namespace gazeloop::session {

/// What SQLite refused, in its words and the system's. Does not leave this room: users of the room
/// get an Error or a RecordingStatus.
class DatabaseError : public std::runtime_error {
  public:
    explicit DatabaseError(sqlite3* database);
    [[nodiscard]] int code() const { return code_; }  ///< SQLite's primary result code

  private:
    int code_;
};

/// An open SQLite file, used by one thread at a time. Every member throws DatabaseError.
class Database {
  public:
    enum class Access { ReadOnly, ReadWrite };

    /// The file must exist; SQLite itself creates nothing but its own companions (-wal, -shm).
    Database(const std::filesystem::path& file, Access access);

    /// Runs statements that return nothing of interest.
    void execute(const char* sql);

    /// Ends a transaction without its changes, if one is open.
    void roll_back();

    /// Whether the file no longer lies where it was opened (renamed or deleted).
    [[nodiscard]] bool moved() const;

    [[nodiscard]] sqlite3* handle() const { return handle_.get(); }

  private:
    struct Close {
        void operator()(sqlite3* database) const;
    };
    std::unique_ptr<sqlite3, Close> handle_;
};

}  // namespace gazeloop::session
