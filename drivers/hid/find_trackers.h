#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "drivers/device/found_device.h"
#include "drivers/hid/eye_tracker_layout.h"

namespace gazeloop::drivers::hid {

/// A HID device that says it is an eye tracker.
struct FoundTracker {
    FoundDevice device;
    /// What its descriptor says; an error where it cannot be used.
    Expected<EyeTrackerLayout> layout{};
    /// How often the host asks it for reports. 0 where they come by themselves, or where it is
    /// unknown (radio links: their delay belongs to the profile).
    std::int64_t polling_ns = 0;
};

/// The eye trackers that are plugged in, each once. Their descriptors come from sysfs, so that a
/// tracker is found even where it may not be opened.
[[nodiscard]] std::vector<FoundTracker> find_trackers();

/// The udev rule that lets whoever sits at the computer open the device.
[[nodiscard]] std::string udev_rule(std::uint16_t vendor, std::uint16_t product);

}  // namespace gazeloop::drivers::hid
