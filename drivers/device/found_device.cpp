#include "drivers/device/found_device.h"

#include <fmt/format.h>
#include <unistd.h>

#include <cerrno>
#include <system_error>

namespace gazeloop::drivers {

std::string FoundDevice::text() const {
    return has_ids() ? fmt::format("{} ({:04x}:{:04x}) at {}", name, vendor, product, path)
                     : fmt::format("{} at {}", name, path);
}

void check_access(FoundDevice& device, const std::string& rule) {
    if (access(device.path.c_str(), R_OK | W_OK) == 0) {
        return;
    }
    const int why = errno;
    if (why == EACCES) {
        device.missing_rule = rule;
        device.access_problem = fmt::format(
            "{} may not be opened (permission denied): gazeloop devices shows the "
            "udev rule that cures it",
            device.path);
    } else {
        device.access_problem = fmt::format("{} cannot be opened: {}", device.path,
                                            std::generic_category().message(why));
    }
}

}  // namespace gazeloop::drivers
