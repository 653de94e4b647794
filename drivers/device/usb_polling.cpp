#include "drivers/device/usb_polling.h"

#include <algorithm>
#include <charconv>
#include <filesystem>
#include <fstream>
#include <string_view>
#include <system_error>

namespace gazeloop::drivers {
namespace {

namespace fs = std::filesystem;

std::string first_line(const fs::path& file) {
    std::string line;
    std::ifstream in(file);
    std::getline(in, line);
    return line;
}

/// Of "4ms" or "125us"; 0 where it is neither.
std::int64_t interval_ns(std::string_view text) {
    std::int64_t count = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), count);
    const std::string_view unit = text.substr(static_cast<std::size_t>(end - text.data()));
    // 2^15 microframes are the longest there are: 4.1 s.
    constexpr std::int64_t kMost = 10'000'000;
    if (error != std::errc() || count < 0 || count > kMost) {
        return 0;
    }
    return unit == "us" ? count * 1'000 : unit == "ms" ? count * 1'000'000 : 0;
}

std::int64_t longest_interval_ns(const fs::path& interface) {
    std::int64_t longest_ns = 0;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(interface, error)) {
        const fs::path& endpoint = entry.path();
        if (endpoint.filename().string().starts_with("ep_") &&
            first_line(endpoint / "type") == "Interrupt" &&
            first_line(endpoint / "direction") == "in") {
            longest_ns = std::max(longest_ns, interval_ns(first_line(endpoint / "interval")));
        }
    }
    return longest_ns;
}

}  // namespace

std::int64_t usb_polling_ns(const std::string& syspath) {
    if (syspath.starts_with("/sys/devices/virtual/")) {
        return 0;
    }
    std::error_code error;
    for (fs::path at = syspath; at.has_relative_path(); at = at.parent_path()) {
        if (fs::exists(at / "bInterfaceNumber", error)) {
            const std::int64_t interval = longest_interval_ns(at);
            return interval > 0 ? interval : kUsualPolling_ns;
        }
    }
    return kUsualPolling_ns;
}

}  // namespace gazeloop::drivers
