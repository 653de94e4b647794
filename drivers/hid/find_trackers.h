#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "drivers/hid/eye_tracker_layout.h"

namespace gazeloop::drivers::hid {

/// A HID device that says it is an eye tracker.
struct FoundTracker {
    std::string path;  ///< /dev/hidrawN
    std::string name;  ///< "" where it has none
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    /// What its descriptor says; an error where it is no good.
    Expected<EyeTrackerLayout> layout{};
    /// Why it cannot be opened; none where it can.
    std::optional<std::string> access_problem;
    bool needs_rule = false;  ///< and udev_rule() is the remedy

    /// "NAME (054c:0cde) at /dev/hidraw0".
    [[nodiscard]] std::string text() const;
};

/// The eye trackers that are plugged in, each once. Their descriptors come from sysfs, so that a
/// tracker is found even where it may not be opened.
[[nodiscard]] std::vector<FoundTracker> find_trackers();

/// The udev rule that lets whoever sits at the computer open the device.
[[nodiscard]] std::string udev_rule(std::uint16_t vendor, std::uint16_t product);

}  // namespace gazeloop::drivers::hid
