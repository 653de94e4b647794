#include "runtime/report/page/number_stream.h"

#include <zlib.h>

#include <array>
#include <bit>
#include <cstddef>
#include <stdexcept>

namespace gazeloop::report::page {
namespace {

constexpr unsigned kGroupBits = 7;
constexpr std::uint64_t kGroup = 0x7f;
constexpr std::uint64_t kFollows = 0x80;

/// 0, -1, 1, -2 ... become 0, 1, 2, 3 ...
std::uint64_t zigzag(std::int64_t number) {
    return (std::bit_cast<std::uint64_t>(number) << 1U) ^
           std::bit_cast<std::uint64_t>(number >> 63U);
}

std::string deflated(std::string_view bytes) {
    std::string result(compressBound(bytes.size()), '\0');
    uLongf size = result.size();
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast): zlib's bytes are unsigned
    auto* const to = reinterpret_cast<Bytef*>(result.data());
    // NOLINTNEXTLINE(cppcoreguidelines-pro-type-reinterpret-cast)
    const auto* const from = reinterpret_cast<const Bytef*>(bytes.data());
    if (compress2(to, &size, from, bytes.size(), Z_DEFAULT_COMPRESSION) != Z_OK) {
        throw std::runtime_error("zlib: out of memory");  // nothing else can happen here
    }
    result.resize(size);
    return result;
}

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

}  // namespace

void NumberStream::add(std::optional<std::int64_t> number) {
    std::uint64_t code = 0;
    if (number) {
        code = zigzag(*number - before_) + 1;
        before_ = *number;
    }
    for (; code > kGroup; code >>= kGroupBits) {
        bytes_ += static_cast<char>((code & kGroup) | kFollows);
    }
    bytes_ += static_cast<char>(code);
}

std::string packed(std::string_view bytes) { return base64(deflated(bytes)); }

}  // namespace gazeloop::report::page
