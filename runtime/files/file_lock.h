#pragma once

#include <filesystem>

#include "runtime/error.h"

namespace gazeloop::files {

/// Keeps a second program from doing what one alone may do: a file that is there, and locked, as
/// long as the object lives. A killed program's lock goes with it; its file stays and is taken
/// over.
class FileLock {
  public:
    FileLock() = default;  ///< nothing is locked

    /// Errors (BadInput): another program has it, of which `doing` says what it does; the file
    /// cannot be made or locked.
    static Expected<FileLock> take(const std::filesystem::path& file, const char* doing);
    FileLock(const FileLock&) = delete;
    FileLock& operator=(const FileLock&) = delete;
    FileLock(FileLock&& other) noexcept;
    FileLock& operator=(FileLock&& other) noexcept;
    ~FileLock();

  private:
    std::filesystem::path file_;
    int descriptor_ = -1;
};

}  // namespace gazeloop::files
