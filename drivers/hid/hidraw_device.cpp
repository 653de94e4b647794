#include "drivers/hid/hidraw_device.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <hidapi.h>
#include <linux/hidraw.h>
#include <sys/file.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <mutex>
#include <system_error>
#include <utility>

#include "runtime/time/clock.h"

namespace gazeloop::drivers::hid {
namespace {

/// The size in a request's code has 14 bits.
constexpr std::size_t kLongestFeature = _IOC_SIZEMASK;

hid_device_* open_with_hidapi(const std::string& path) {
    static std::mutex one_at_a_time;
    const std::scoped_lock lock(one_at_a_time);
    return hid_open_path(path.c_str());
}

/// Of a request that began then. Not every transport says ETIMEDOUT where nothing was answered
/// (Bluetooth and uhid: EIO), but no device takes so long to refuse.
RequestFailure failure(int result, std::int64_t begin_ns) {
    constexpr double kLongestRefusal_s = 1.0;
    const bool timed_out = result < 0 && errno == ETIMEDOUT;
    const double seconds = static_cast<double>(time::monotonic_ns() - begin_ns) * 1e-9;
    return {.why = timed_out || seconds >= kLongestRefusal_s ? RequestFailure::Why::Unanswered
                                                             : RequestFailure::Why::Refused,
            .seconds = seconds};
}

}  // namespace

HidrawDevice::Node::Node(const std::string& path) : fd_(::open(path.c_str(), O_RDWR | O_CLOEXEC)) {}

HidrawDevice::Node::Node(Node&& other) noexcept : fd_(std::exchange(other.fd_, -1)) {}

HidrawDevice::Node::~Node() {
    if (fd_ >= 0) {
        ::close(fd_);
    }
}

void HidrawDevice::Close::operator()(hid_device_* device) const { hid_close(device); }

std::unexpected<Error> HidrawDevice::error(const std::string& what) const {
    return std::unexpected(Error{ErrorKind::NoDevice, fmt::format("{}: {}", path_, what)});
}

Expected<HidrawDevice> HidrawDevice::open(const std::string& path) {
    HidrawDevice device(path, Node(path));
    const int fd = device.node_.fd();
    int size = 0;  // of its descriptor: whether it is a HID device at all
    if (fd < 0 || ioctl(fd, HIDIOCGRDESCSIZE, &size) < 0) {
        return device.error(fmt::format("cannot be opened as a HID device: {}",
                                        std::generic_category().message(errno)));
    }
    device.device_.reset(open_with_hidapi(path));
    if (device.device_ == nullptr) {
        return device.error("cannot be opened as a HID device");
    }
    // Told to others of our kind (nobody_else_reads); where it cannot be, they think they are
    // alone.
    [[maybe_unused]] const int locked = flock(fd, LOCK_SH | LOCK_NB);
    return device;
}

bool HidrawDevice::nobody_else_reads() const { return flock(node_.fd(), LOCK_EX | LOCK_NB) == 0; }

Expected<std::size_t> HidrawDevice::read(std::span<std::uint8_t> report,
                                         std::chrono::milliseconds longest) {
    errno = 0;
    const int bytes = hid_read_timeout(device_.get(), report.data(), report.size(),
                                       static_cast<int>(longest.count()));
    if (bytes < 0 && errno == EINTR) {
        return 0;
    }
    if (bytes < 0) {
        return error("cannot be read any more (unplugged, or it failed)");
    }
    return static_cast<std::size_t>(bytes);
}

std::expected<std::vector<std::uint8_t>, RequestFailure> HidrawDevice::feature(
    std::uint8_t id, std::size_t payload_bytes) {
    std::vector<std::uint8_t> report(std::min(1 + payload_bytes, kLongestFeature), 0);
    report.front() = id;
    const std::int64_t begin_ns = time::monotonic_ns();
    const int bytes = ioctl(node_.fd(), HIDIOCGFEATURE(report.size()), report.data());
    if (bytes <= 0) {
        return std::unexpected(failure(bytes, begin_ns));
    }
    report.resize(std::min(report.size(), static_cast<std::size_t>(bytes)));
    return report;
}

std::expected<void, RequestFailure> HidrawDevice::send_feature(
    std::span<const std::uint8_t> report) {
    if (report.size() > kLongestFeature) {
        return std::unexpected(RequestFailure{});
    }
    const std::int64_t begin_ns = time::monotonic_ns();
    const int bytes = ioctl(node_.fd(), HIDIOCSFEATURE(report.size()), report.data());
    if (bytes < 0) {
        return std::unexpected(failure(bytes, begin_ns));
    }
    return {};
}

}  // namespace gazeloop::drivers::hid
