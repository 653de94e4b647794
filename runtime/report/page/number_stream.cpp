#include "runtime/report/page/number_stream.h"

#include <zlib.h>

#include <array>
#include <bit>
#include <cstddef>
#include <stdexcept>

#include "runtime/report/page/base64.h"

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
