#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

namespace gazeloop::drivers {

/// A tracker that the kernel knows and nobody has opened yet.
struct FoundDevice {
    std::string path;  ///< /dev/...
    std::string name;
    std::uint16_t vendor = 0;
    std::uint16_t product = 0;
    /// Why it cannot be opened; none where it can.
    std::optional<std::string> access_problem;
    /// The udev rule that cures that; empty if a missing rule is not the cause.
    std::string missing_rule;

    /// Whether it is on a bus that knows makers and products.
    [[nodiscard]] bool has_ids() const { return vendor != 0 || product != 0; }
    /// "NAME (054c:0cde) at /dev/hidraw0".
    [[nodiscard]] std::string text() const;
};

/// What to do with a missing rule. It goes into a file of its own, because a file named like the
/// installed config/udev/70-gazeloop.rules would replace that one. It comes before
/// 73-seat-late.rules, which acts on its tag.
inline constexpr std::string_view kRuleRemedy =
    "as root, add this line to /etc/udev/rules.d/70-gazeloop-local.rules, then plug the tracker in "
    "again, logged in at this computer:";

/// Sets the access problem of a device, if it has one. `rule` lets whoever sits at the computer
/// open it.
void check_access(FoundDevice& device, const std::string& rule);

}  // namespace gazeloop::drivers
