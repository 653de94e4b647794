#include "drivers/hid/hidraw_device.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <hidapi.h>
#include <linux/hidraw.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <system_error>
#include <utility>

namespace gazeloop::drivers::hid {
namespace {

/// An open file, closed in the end.
class File {
  public:
    explicit File(const std::string& path) : fd_(::open(path.c_str(), O_RDWR | O_CLOEXEC)) {}
    File(const File&) = delete;
    File& operator=(const File&) = delete;
    ~File() {
        if (fd_ >= 0) {
            ::close(fd_);
        }
    }
    [[nodiscard]] int fd() const { return fd_; }

  private:
    int fd_;
};

std::unexpected<Error> no_device(const std::string& path, const std::string& what) {
    return std::unexpected(Error{ExitCode::NoDevice, fmt::format("{}: {}", path, what)});
}

}  // namespace

void HidrawDevice::Close::operator()(hid_device_* device) const { hid_close(device); }

std::unexpected<Error> HidrawDevice::error(const std::string& what) const {
    return no_device(path_, what);
}

Expected<HidrawDevice> HidrawDevice::open(const std::string& path) {
    const File probe(path);
    int size = 0;
    if (probe.fd() < 0 || ioctl(probe.fd(), HIDIOCGRDESCSIZE, &size) < 0) {
        return no_device(path, fmt::format("cannot be opened as a HID device: {}",
                                           std::generic_category().message(errno)));
    }
    hid_device_* const device = hid_open_path(path.c_str());
    if (device == nullptr) {
        return no_device(path, "cannot be opened as a HID device");
    }
    return HidrawDevice(path, device);
}

Expected<std::size_t> HidrawDevice::read(std::span<std::uint8_t> report,
                                         std::chrono::milliseconds longest) {
    const int bytes = hid_read_timeout(device_.get(), report.data(), report.size(),
                                       static_cast<int>(longest.count()));
    if (bytes < 0) {
        return error("cannot be read any more (unplugged, or it failed)");
    }
    return static_cast<std::size_t>(bytes);
}

std::optional<std::vector<std::uint8_t>> HidrawDevice::feature(std::uint8_t id,
                                                               std::size_t payload_bytes) {
    std::vector<std::uint8_t> report(1 + payload_bytes, 0);
    report.front() = id;
    const int bytes = hid_get_feature_report(device_.get(), report.data(), report.size());
    if (bytes <= 0) {
        return std::nullopt;
    }
    report.resize(std::min(report.size(), static_cast<std::size_t>(bytes)));
    return report;
}

Expected<void> HidrawDevice::send_feature(std::span<const std::uint8_t> report) {
    if (hid_send_feature_report(device_.get(), report.data(), report.size()) < 0) {
        return error("does not take the request");
    }
    return {};
}

}  // namespace gazeloop::drivers::hid
