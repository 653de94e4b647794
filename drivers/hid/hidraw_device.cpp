#include "drivers/hid/hidraw_device.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <linux/hidraw.h>
#include <poll.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace gazeloop::drivers::hid {
namespace {

/// The size in a request's code has 14 bits.
constexpr std::size_t kLongestFeature = _IOC_SIZEMASK;

}  // namespace

std::unexpected<Error> HidrawDevice::error(const std::string& what) const {
    return std::unexpected(Error{ExitCode::NoDevice, fmt::format("{}: {}", path_, what)});
}

Expected<HidrawDevice> HidrawDevice::open(const std::string& path) {
    HidrawDevice device(path, ::open(path.c_str(), O_RDWR | O_CLOEXEC | O_NONBLOCK));
    int size = 0;  // of its descriptor: whether it is a HID device at all
    if (device.fd_ < 0 || ioctl(device.fd_, HIDIOCGRDESCSIZE, &size) < 0) {
        return device.error(fmt::format("cannot be opened as a HID device: {}",
                                        std::generic_category().message(errno)));
    }
    // Told to others of our kind (nobody_else_reads); where it cannot be, they think they are
    // alone.
    [[maybe_unused]] const int locked = flock(device.fd_, LOCK_SH | LOCK_NB);
    return device;
}

bool HidrawDevice::nobody_else_reads() const { return flock(fd_, LOCK_EX | LOCK_NB) == 0; }

HidrawDevice::HidrawDevice(HidrawDevice&& other) noexcept
    : path_(std::move(other.path_)), fd_(std::exchange(other.fd_, -1)) {}

HidrawDevice::~HidrawDevice() {
    if (fd_ >= 0) {
        ::close(fd_);
    }
}

Expected<std::size_t> HidrawDevice::read(std::span<std::uint8_t> report,
                                         std::chrono::milliseconds longest) {
    pollfd file{.fd = fd_, .events = POLLIN, .revents = 0};
    const int ready = ::poll(&file, 1, static_cast<int>(longest.count()));
    if (ready == 0 || (ready < 0 && errno == EINTR)) {
        return 0;
    }
    // A node that is hung up says why when it is read.
    const ssize_t bytes = ready < 0 ? -1 : ::read(fd_, report.data(), report.size());
    if (bytes < 0 && (errno == EAGAIN || errno == EINTR)) {
        return 0;
    }
    if (bytes <= 0) {
        return error("cannot be read any more (unplugged, or it failed)");
    }
    return static_cast<std::size_t>(bytes);
}

std::optional<std::vector<std::uint8_t>> HidrawDevice::feature(std::uint8_t id,
                                                               std::size_t payload_bytes) {
    std::vector<std::uint8_t> report(std::min(1 + payload_bytes, kLongestFeature), 0);
    report.front() = id;
    const int bytes = ioctl(fd_, HIDIOCGFEATURE(report.size()), report.data());
    if (bytes <= 0) {
        return std::nullopt;
    }
    report.resize(std::min(report.size(), static_cast<std::size_t>(bytes)));
    return report;
}

Expected<void> HidrawDevice::send_feature(std::span<const std::uint8_t> report) {
    if (report.size() > kLongestFeature) {
        return error(fmt::format("a request of {} bytes cannot be sent: at most {}", report.size(),
                                 kLongestFeature));
    }
    // The kernel only reads what it is told to send.
    if (ioctl(fd_, HIDIOCSFEATURE(report.size()), report.data()) < 0) {
        return error("does not take the request");
    }
    return {};
}

}  // namespace gazeloop::drivers::hid
