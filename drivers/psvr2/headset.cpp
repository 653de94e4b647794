#include "drivers/psvr2/headset.h"

#include <utility>

#include "drivers/device/udev.h"
#include "drivers/psvr2/usb_headset.h"

namespace gazeloop::drivers::psvr2 {
namespace {

constexpr std::uint16_t kVendor = 0x054C;
constexpr std::uint16_t kProduct = 0x0CDE;
/// How the kernel writes them, before the device's version.
constexpr const char* kKernelId = "54c/cde/";
/// As in config/udev/70-gazeloop.rules.
constexpr const char* kRule =
    R"(SUBSYSTEM=="usb", ATTR{idVendor}=="054c", ATTR{idProduct}=="0cde", TAG+="uaccess")";

}  // namespace

std::vector<FoundDevice> find_headsets() {
    std::vector<FoundDevice> headsets;
    for (const KernelDevice& device : kernel_devices("usb", "")) {
        if (device.property("DEVTYPE") != "usb_device" ||
            !device.property("PRODUCT").starts_with(kKernelId)) {
            continue;
        }
        FoundDevice headset;
        headset.path = device.node;
        headset.name = "PlayStation VR2";
        headset.vendor = kVendor;
        headset.product = kProduct;
        check_access(headset, kRule);
        headsets.push_back(std::move(headset));
    }
    return headsets;
}

Expected<std::unique_ptr<TrackerDevice>> open_headset(const FoundDevice& found,
                                                      const Psvr2Options& options) {
    if (found.access_problem) {
        return std::unexpected(Error{ErrorKind::NoDevice, *found.access_problem});
    }
    auto context = UsbContext::create();
    if (!context) {
        return std::unexpected(std::move(context.error()));
    }
    auto handle = UsbHandle::open(*context, found);
    if (!handle) {
        return std::unexpected(std::move(handle.error()));
    }
    return std::make_unique<UsbHeadset>(std::move(*context), std::move(*handle), found, options);
}

Expected<std::unique_ptr<TrackerDevice>> open_any_headset(const Psvr2Options& options) {
    const std::vector<FoundDevice> headsets = find_headsets();
    if (headsets.empty()) {
        return nullptr;
    }
    return open_headset(headsets.front(), options);
}

std::vector<TrackerProbe> probe_headsets(const Psvr2Options& options,
                                         std::chrono::milliseconds listen,
                                         const StopRequested& stop) {
    std::vector<TrackerProbe> probes;
    for (const FoundDevice& found : find_headsets()) {
        probes.push_back(probe_tracker(
            kSupport, found, [&](const StopRequested&) { return open_headset(found, options); },
            listen, stop));
    }
    return probes;
}

}  // namespace gazeloop::drivers::psvr2
