#include "drivers/hid/find_trackers.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <charconv>
#include <fstream>
#include <iterator>
#include <system_error>
#include <utility>

#include "drivers/device/udev.h"

namespace gazeloop::drivers::hid {
namespace {

std::vector<std::uint8_t> read_bytes(const std::string& file) {
    std::ifstream in(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
}

/// Of "BUS:VENDOR:PRODUCT", 4 and twice 8 hexadecimal digits.
std::uint16_t id_part(const std::string& hid_id, std::size_t begin) {
    constexpr std::size_t kDigits = 8;
    std::uint32_t value = 0;
    if (hid_id.size() >= begin + kDigits) {
        std::from_chars(hid_id.data() + begin, hid_id.data() + begin + kDigits, value, 16);
    }
    return static_cast<std::uint16_t>(value);
}

void check_access(FoundTracker& tracker) {
    if (access(tracker.path.c_str(), R_OK | W_OK) == 0) {
        return;
    }
    const int why = errno;
    tracker.needs_rule = why == EACCES;
    tracker.access_problem =
        tracker.needs_rule
            ? fmt::format(
                  "{} may not be opened (permission denied): gazeloop devices shows the "
                  "udev rule that cures it",
                  tracker.path)
            : fmt::format("{} cannot be opened: {}", tracker.path,
                          std::generic_category().message(why));
}

}  // namespace

std::string FoundTracker::text() const {
    return fmt::format("{} ({:04x}:{:04x}) at {}", name.empty() ? "HID eye tracker" : name, vendor,
                       product, path);
}

std::vector<FoundTracker> find_trackers() {
    constexpr std::size_t kVendorBegin = 5;
    constexpr std::size_t kProductBegin = 14;
    std::vector<FoundTracker> trackers;
    for (const KernelDevice& device : kernel_devices("hidraw", "hid")) {
        const auto descriptor =
            parse_report_descriptor(read_bytes(device.syspath + "/device/report_descriptor"));
        if (!descriptor || !describes_eye_tracker(*descriptor)) {
            continue;
        }
        const std::string id = device.property("HID_ID");
        FoundTracker tracker{.path = device.node,
                             .name = device.property("HID_NAME"),
                             .vendor = id_part(id, kVendorBegin),
                             .product = id_part(id, kProductBegin),
                             .layout = find_eye_tracker(*descriptor),
                             .access_problem = std::nullopt};
        check_access(tracker);
        trackers.push_back(std::move(tracker));
    }
    return trackers;
}

std::string udev_rule(std::uint16_t vendor, std::uint16_t product) {
    return fmt::format(
        R"(KERNEL=="hidraw*", SUBSYSTEM=="hidraw", KERNELS=="*:{:04X}:{:04X}.*", TAG+="uaccess")",
        vendor, product);
}

}  // namespace gazeloop::drivers::hid
