#include "runtime/memory/scratch_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/magic.h>
#include <sys/mman.h>
#include <sys/statfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <utility>

#include "runtime/environment.h"

namespace gazeloop::memory {
namespace {

std::unexpected<Error> refusal(const std::string& folder, int reason) {
    return std::unexpected(
        Error{ErrorKind::BadInput,
              fmt::format("{}: no scratch file for what does not fit into memory ({}); let TMPDIR "
                          "name a folder that is on a disk and has room",
                          folder, std::strerror(reason))});
}

}  // namespace

std::string scratch_folder() { return environment_value("TMPDIR").value_or("/var/tmp"); }

Expected<ScratchFile> ScratchFile::make(const std::string& folder) {
    int file = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (file < 0 && (errno == EOPNOTSUPP || errno == EISDIR)) {  // a file system without such
        std::string name = folder + "/gazeloop-XXXXXX";
        file = mkostemp(name.data(), O_CLOEXEC);
        if (file >= 0) {
            unlink(name.c_str());
        }
    }
    if (file < 0) {
        return refusal(folder, errno);
    }
    return ScratchFile(folder, file);
}

ScratchFile::ScratchFile(std::string folder, int descriptor)
    : folder_(std::move(folder)), descriptor_(descriptor) {}

ScratchFile::ScratchFile(ScratchFile&& other) noexcept
    : folder_(std::move(other.folder_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

ScratchFile& ScratchFile::operator=(ScratchFile&& other) noexcept {
    std::swap(folder_, other.folder_);
    std::swap(descriptor_, other.descriptor_);
    return *this;
}

ScratchFile::~ScratchFile() {
    if (descriptor_ >= 0) {
        close(descriptor_);
    }
}

Expected<void> ScratchFile::write(std::size_t at, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t done =
            pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (done < 0 && errno == EINTR) {
            continue;
        }
        if (done <= 0) {
            return refusal(folder_, done < 0 ? errno : ENOSPC);
        }
        at += static_cast<std::size_t>(done);
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
    return {};
}

Expected<void> ScratchFile::read(std::size_t at, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t done = pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(at));
        if (done < 0 && errno == EINTR) {
            continue;
        }
        if (done <= 0) {
            return refusal(folder_, done < 0 ? errno : EIO);
        }
        at += static_cast<std::size_t>(done);
        bytes = bytes.subspan(static_cast<std::size_t>(done));
    }
    return {};
}

Expected<void> ScratchFile::reserve(std::size_t bytes) {
    if (const int no_room = posix_fallocate(descriptor_, 0, static_cast<off_t>(bytes));
        no_room != 0) {
        return std::unexpected(
            Error{ErrorKind::BadInput,
                  fmt::format("{}: no room for a scratch file of {} MiB ({}); let TMPDIR name a "
                              "folder that is on a disk and has room",
                              folder_, (bytes >> 20U) + 1, std::strerror(no_room))});
    }
    return {};
}

Expected<void*> ScratchFile::map(std::size_t bytes) {
    // A page without the disk's room would be a SIGBUS.
    if (auto room = reserve(bytes); !room) {
        return std::unexpected(std::move(room.error()));
    }
    void* const block = mmap(nullptr, bytes, PROT_READ | PROT_WRITE, MAP_SHARED, descriptor_, 0);
    if (block == MAP_FAILED) {
        return refusal(folder_, errno);
    }
    return block;
}

std::string ScratchFile::in_memory() const {
    struct statfs system{};
    const bool memory = fstatfs(descriptor_, &system) == 0 &&
                        (system.f_type == TMPFS_MAGIC || system.f_type == RAMFS_MAGIC);
    return memory ? folder_ : std::string{};
}

}  // namespace gazeloop::memory
