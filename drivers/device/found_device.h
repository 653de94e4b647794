#pragma once

#include <cstdint>
#include <optional>
#include <string>

namespace gazeloop::drivers {

/// A tracker that the kernel knows and nobody has opened yet.
struct FoundDevice {
    std::string path;  ///< /dev/...
    std::string name;
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    /// Why it cannot be opened; none where it can.
    std::optional<std::string> access_problem;
    /// The udev rule that cures that; empty where it is not for lack of one.
    std::string missing_rule;

    /// "NAME (054c:0cde) at /dev/hidraw0".
    [[nodiscard]] std::string text() const;
};

/// Sets the access problem of a device, if it has one. `rule` lets whoever sits at the computer
/// open it.
void check_access(FoundDevice& device, const std::string& rule);

}  // namespace gazeloop::drivers
