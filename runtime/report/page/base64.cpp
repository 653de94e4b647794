#include "runtime/report/page/base64.h"

#include <cstddef>
#include <cstdint>

namespace gazeloop::report::page {

std::string base64(std::string_view bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    constexpr std::size_t kBytes = 3;  // become 4 digits
    std::string text;
    text.reserve((bytes.size() + kBytes - 1) / kBytes * 4);
    for (std::size_t at = 0; at < bytes.size(); at += kBytes) {
        const std::string_view group = bytes.substr(at, kBytes);
        std::uint32_t bits = 0;
        for (std::size_t i = 0; i < kBytes; ++i) {
            bits = bits << 8U | (i < group.size() ? static_cast<std::uint8_t>(group[i]) : 0U);
        }
        for (unsigned digit = 0; digit < 4; ++digit) {
            text += digit <= group.size() ? kDigits[bits >> (18U - 6U * digit) & 63U] : '=';
        }
    }
    return text;
}

}  // namespace gazeloop::report::page
