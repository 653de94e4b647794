#include "drivers/steam_frame/shared_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

#include "runtime/time/clock.h"

namespace gazeloop::drivers::steam_frame {
namespace {

std::unexpected<Error> no_device(std::string message) {
    return std::unexpected(Error{ErrorKind::NoDevice, std::move(message)});
}

std::string why(int error) { return std::generic_category().message(error); }

/// Whether both images are of one sample, whole.
bool same_sample(const Image& a, const Image& b, const Layout& layout) {
    return decode_header(a).counter == decode_header(b).counter &&
           std::ranges::equal(record_in(a, layout), record_in(b, layout));
}

}  // namespace

Expected<std::optional<SharedFile>> SharedFile::open(const std::string& path) {
    // Not blocking, because anybody may put a FIFO into a folder that all may write to.
    const int fd = ::open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK | O_NOCTTY);
    if (fd < 0) {
        const int error = errno;
        if (error == ENOENT || error == ENOTDIR) {
            return std::nullopt;
        }
        return no_device(fmt::format("{} cannot be opened: {}", path, why(error)));
    }
    SharedFile file(fd, path);
    struct stat status{};
    if (fstat(fd, &status) != 0 || !S_ISREG(status.st_mode)) {
        return no_device(
            fmt::format("{} is no regular file, so it is not the eye service's", path));
    }
    return file;
}

SharedFile::SharedFile(SharedFile&& other) noexcept
    : fd_(std::exchange(other.fd_, -1)), path_(std::move(other.path_)) {}

SharedFile::~SharedFile() {
    if (fd_ >= 0) {
        close(fd_);
    }
}

Expected<void> SharedFile::read(Image& image) const {
    ssize_t count = 0;
    do {
        count = pread(fd_, image.data(), image.size(), 0);
    } while (count < 0 && errno == EINTR);
    if (count < 0) {
        return no_device(fmt::format("{} cannot be read: {}", path_, why(errno)));
    }
    if (static_cast<std::size_t>(count) < image.size()) {
        return no_device(
            fmt::format("{} has {} bytes, which is too short for the eye service's {}: another "
                        "program has cut it; restart the headset's eye service",
                        path_, count, image.size()));
    }
    return {};
}

std::optional<std::string> SharedFile::why_gone() const {
    struct stat here{};
    struct stat there{};
    if (fstat(fd_, &here) != 0 || stat(path_.c_str(), &there) != 0) {
        return fmt::format("{} was removed: the eye service has ended", path_);
    }
    if (here.st_dev != there.st_dev || here.st_ino != there.st_ino) {
        return fmt::format("{} was replaced: the eye service was started again", path_);
    }
    return std::nullopt;
}

Expected<bool> read_new(const SharedFile& file, const Layout& layout,
                        std::optional<std::uint32_t> known_counter, std::int64_t settle_ns,
                        Image& image, std::uint64_t& torn) {
    constexpr int kAttempts = 4;
    Image before{};
    if (auto read = file.read(before); !read) {
        return std::unexpected(std::move(read.error()));
    }
    if (decode_header(before).counter == known_counter) {
        return false;
    }
    for (int attempt = 0; attempt < kAttempts; ++attempt) {
        if (settle_ns > 0) {
            time::sleep_until_ns(time::monotonic_ns() + settle_ns);
        }
        if (auto read = file.read(image); !read) {
            return std::unexpected(std::move(read.error()));
        }
        if (same_sample(before, image, layout)) {
            return true;
        }
        ++torn;
        before = image;
    }
    return false;
}

}  // namespace gazeloop::drivers::steam_frame
