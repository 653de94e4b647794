#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace gazeloop::tests {

struct DescriptorCase {
    std::string name;
    std::vector<std::uint8_t> bytes;
    /// Linux departs from HID 1.11 here, on purpose or not, and we follow the standard.
    bool linux_differs = false;
};

/// Descriptors that Linux accepts: those of
/// eye trackers, one for each rule of HID 1.11 that is easily got wrong, and `made_up` more drawn
/// at random. All usages are on pages for which Linux knows no names.
[[nodiscard]] std::vector<DescriptorCase> descriptor_cases(int made_up);

}  // namespace gazeloop::tests
