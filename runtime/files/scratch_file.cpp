#include "runtime/files/scratch_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <string>
#include <system_error>
#include <utility>

#include "runtime/environment.h"

namespace gazeloop::files {
namespace {

std::unexpected<Error> scratch_error(const std::filesystem::path& folder, const std::string& what,
                                     int error) {
    return std::unexpected(
        Error{ErrorKind::BadInput,
              fmt::format("{}: a scratch file {} ({}): name another folder in TMPDIR",
                          folder.string(), what, std::generic_category().message(error))});
}

/// A file without a name, or, where the file system has none such, one whose name is removed.
int open_nameless(const std::filesystem::path& folder) {
    const int descriptor = open(folder.c_str(), O_TMPFILE | O_RDWR | O_CLOEXEC, 0600);
    if (descriptor >= 0 || (errno != EOPNOTSUPP && errno != EISDIR)) {
        return descriptor;
    }
    std::string name = (folder / "gazeloop-XXXXXX").string();
    const int named = mkostemp(name.data(), O_CLOEXEC);
    if (named >= 0) {
        unlink(name.c_str());
    }
    return named;
}

}  // namespace

std::filesystem::path scratch_folder() { return environment_value("TMPDIR").value_or("/var/tmp"); }

Expected<ScratchFile> ScratchFile::create(std::uint64_t bytes,
                                          const std::filesystem::path& folder) {
    const int descriptor = open_nameless(folder);
    if (descriptor < 0) {
        return scratch_error(folder, "cannot be made", errno);
    }
    ScratchFile file(folder, descriptor);
    if (const int error = posix_fallocate(descriptor, 0, static_cast<off_t>(bytes)); error != 0) {
        return scratch_error(folder, fmt::format("of {} MiB finds no room", (bytes >> 20U) + 1),
                             error);
    }
    return file;
}

ScratchFile::ScratchFile(std::filesystem::path folder, int descriptor)
    : folder_(std::move(folder)), descriptor_(descriptor) {}

ScratchFile::ScratchFile(ScratchFile&& other) noexcept
    : folder_(std::move(other.folder_)), descriptor_(std::exchange(other.descriptor_, -1)) {}

ScratchFile::~ScratchFile() {
    if (descriptor_ >= 0) {
        close(descriptor_);
    }
}

Expected<void> ScratchFile::write(std::uint64_t offset, std::span<const std::byte> bytes) {
    while (!bytes.empty()) {
        const ssize_t done =
            pwrite(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (done < 0 && errno != EINTR) {
            return scratch_error(folder_, "cannot be written", errno);
        }
        if (done > 0) {
            offset += static_cast<std::uint64_t>(done);
            bytes = bytes.subspan(static_cast<std::size_t>(done));
        }
    }
    return {};
}

Expected<void> ScratchFile::read(std::uint64_t offset, std::span<std::byte> bytes) const {
    while (!bytes.empty()) {
        const ssize_t done =
            pread(descriptor_, bytes.data(), bytes.size(), static_cast<off_t>(offset));
        if (done == 0 || (done < 0 && errno != EINTR)) {
            return scratch_error(folder_, "cannot be read", done == 0 ? EIO : errno);
        }
        if (done > 0) {
            offset += static_cast<std::uint64_t>(done);
            bytes = bytes.subspan(static_cast<std::size_t>(done));
        }
    }
    return {};
}

}  // namespace gazeloop::files
