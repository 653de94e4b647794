#include "drivers/hid/find_trackers.h"

#include <fmt/format.h>

#include <charconv>
#include <fstream>
#include <iterator>
#include <string_view>
#include <utility>

#include "drivers/device/udev.h"
#include "drivers/device/usb_polling.h"

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

}  // namespace

std::vector<FoundTracker> find_trackers() {
    constexpr std::string_view kUsbBus = "0003:";
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
        const std::string name = device.property("HID_NAME");
        FoundTracker tracker;
        tracker.device.path = device.node;
        tracker.device.name = name.empty() ? "HID eye tracker" : name;
        tracker.device.vendor = id_part(id, kVendorBegin);
        tracker.device.product = id_part(id, kProductBegin);
        tracker.layout = find_eye_tracker(*descriptor);
        tracker.polling_ns = id.starts_with(kUsbBus) ? usb_polling_ns(device.syspath) : 0;
        check_access(tracker.device, udev_rule(tracker.device.vendor, tracker.device.product));
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
