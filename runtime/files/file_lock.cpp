#include "runtime/files/file_lock.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

namespace gazeloop::files {
namespace {

std::string errno_text() { return std::generic_category().message(errno); }

std::unexpected<Error> no_lock(const std::filesystem::path& file, const std::string& why) {
    return std::unexpected(Error{ErrorKind::BadInput, fmt::format("{}: {}", file.string(), why)});
}

}  // namespace

Expected<FileLock> FileLock::take(const std::filesystem::path& file, const char* doing) {
    for (;;) {
        FileLock lock;
        lock.descriptor_ = ::open(file.c_str(), O_RDWR | O_CREAT | O_CLOEXEC | O_NOFOLLOW, 0600);
        if (lock.descriptor_ < 0) {
            return no_lock(file, fmt::format("cannot be made ({})", errno_text()));
        }
        if (::flock(lock.descriptor_, LOCK_EX | LOCK_NB) != 0) {
            return errno == EWOULDBLOCK
                       ? no_lock(file, fmt::format("another program {}: wait until it ends", doing))
                       : no_lock(file, fmt::format("cannot be locked ({}): use a folder of a file "
                                                   "system that has locks",
                                                   errno_text()));
        }
        // Whoever had the lock before may have removed the file since it was opened here.
        struct stat held{};
        struct stat there{};
        if (::fstat(lock.descriptor_, &held) == 0 && ::stat(file.c_str(), &there) == 0 &&
            held.st_ino == there.st_ino && held.st_dev == there.st_dev) {
            lock.file_ = file;
            return lock;
        }
    }
}

FileLock::FileLock(FileLock&& other) noexcept
    : file_(std::exchange(other.file_, {})), descriptor_(std::exchange(other.descriptor_, -1)) {}

FileLock& FileLock::operator=(FileLock&& other) noexcept {
    std::swap(file_, other.file_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

FileLock::~FileLock() {
    if (descriptor_ < 0) {
        return;
    }
    if (!file_.empty()) {
        ::unlink(file_.c_str());
    }
    ::close(descriptor_);
}

}  // namespace gazeloop::files
