#pragma once

#include <chrono>
#include <memory>
#include <string>
#include <vector>

struct udev;
struct udev_monitor;

namespace gazeloop::drivers {

/// A device that the kernel knows.
struct KernelDevice {
    std::string node;     ///< /dev/...; may be empty
    std::string syspath;  ///< /sys/devices/...
    /// Of the device and, where it lacks them, its parents: HID_ID, HID_NAME, ID_VENDOR_ID ...
    struct Property {
        std::string name;
        std::string value;
    };
    std::vector<Property> properties;

    /// "" where there is none.
    [[nodiscard]] std::string property(std::string_view name) const;
};

/// All devices of a subsystem ("hidraw", "usb"), by syspath. `parent` names the subsystem of the
/// parent whose properties are added ("hid"; empty: none).
[[nodiscard]] std::vector<KernelDevice> kernel_devices(const std::string& subsystem,
                                                       const std::string& parent);

/// Wakes its owner when a device comes or goes.
class DeviceWatch {
  public:
    /// Without udev (a container), and for no subsystem (""), waits still end, but only by time.
    explicit DeviceWatch(const std::string& subsystem);
    DeviceWatch(const DeviceWatch&) = delete;
    DeviceWatch& operator=(const DeviceWatch&) = delete;
    ~DeviceWatch();

    /// Returns after the time, or earlier when something came or went, or `wake_fd` (-1: none) can
    /// be read.
    void wait(std::chrono::milliseconds longest, int wake_fd);

  private:
    udev* udev_ = nullptr;
    udev_monitor* monitor_ = nullptr;
};

}  // namespace gazeloop::drivers
