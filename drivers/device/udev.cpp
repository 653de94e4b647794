#include "drivers/device/udev.h"

#include <libudev.h>
#include <poll.h>

#include <algorithm>
#include <array>

namespace gazeloop::drivers {
namespace {

struct Unref {
    void operator()(udev* object) const { udev_unref(object); }
    void operator()(udev_enumerate* object) const { udev_enumerate_unref(object); }
    void operator()(udev_device* object) const { udev_device_unref(object); }
};
template <typename T>
using Owned = std::unique_ptr<T, Unref>;

std::string text_or_empty(const char* text) { return text == nullptr ? "" : text; }

void add_properties(KernelDevice& device, udev_device* from) {
    udev_list_entry* entry = nullptr;
    udev_list_entry_foreach(entry, udev_device_get_properties_list_entry(from)) {
        const std::string name = text_or_empty(udev_list_entry_get_name(entry));
        if (device.property(name).empty()) {
            device.properties.push_back({name, text_or_empty(udev_list_entry_get_value(entry))});
        }
    }
}

}  // namespace

std::string KernelDevice::property(std::string_view name) const {
    const auto found = std::ranges::find(properties, name, &Property::name);
    return found == properties.end() ? "" : found->value;
}

std::vector<KernelDevice> kernel_devices(const std::string& subsystem, const std::string& parent) {
    std::vector<KernelDevice> devices;
    const Owned<udev> library(udev_new());
    if (!library) {
        return devices;
    }
    const Owned<udev_enumerate> found(udev_enumerate_new(library.get()));
    if (!found || udev_enumerate_add_match_subsystem(found.get(), subsystem.c_str()) < 0 ||
        udev_enumerate_scan_devices(found.get()) < 0) {
        return devices;
    }
    udev_list_entry* entry = nullptr;
    udev_list_entry_foreach(entry, udev_enumerate_get_list_entry(found.get())) {
        const Owned<udev_device> device(
            udev_device_new_from_syspath(library.get(), udev_list_entry_get_name(entry)));
        if (!device) {
            continue;  // gone meanwhile
        }
        KernelDevice added;
        added.node = text_or_empty(udev_device_get_devnode(device.get()));
        added.syspath = text_or_empty(udev_device_get_syspath(device.get()));
        add_properties(added, device.get());
        if (!parent.empty()) {
            // Belongs to the device: not to be released.
            if (udev_device* const above = udev_device_get_parent_with_subsystem_devtype(
                    device.get(), parent.c_str(), nullptr)) {
                add_properties(added, above);
            }
        }
        devices.push_back(std::move(added));
    }
    std::ranges::sort(devices, {}, &KernelDevice::syspath);
    return devices;
}

DeviceWatch::DeviceWatch(const std::string& subsystem)
    : udev_(subsystem.empty() ? nullptr : udev_new()) {
    if (udev_ == nullptr) {
        return;
    }
    monitor_ = udev_monitor_new_from_netlink(udev_, "udev");
    if (monitor_ != nullptr) {
        udev_monitor_filter_add_match_subsystem_devtype(monitor_, subsystem.c_str(), nullptr);
        udev_monitor_enable_receiving(monitor_);
    }
}

DeviceWatch::~DeviceWatch() {
    if (monitor_ != nullptr) {
        udev_monitor_unref(monitor_);
    }
    if (udev_ != nullptr) {
        udev_unref(udev_);
    }
}

void DeviceWatch::wait(std::chrono::milliseconds longest, int wake_fd) {
    // A negative file is passed over by poll().
    std::array<pollfd, 2> files{
        pollfd{monitor_ != nullptr ? udev_monitor_get_fd(monitor_) : -1, POLLIN, 0},
        pollfd{wake_fd, POLLIN, 0}};
    poll(files.data(), files.size(), static_cast<int>(longest.count()));
    if ((files[0].revents & POLLIN) != 0) {
        while (udev_device* const device = udev_monitor_receive_device(monitor_)) {
            udev_device_unref(device);
        }
    }
}

}  // namespace gazeloop::drivers
