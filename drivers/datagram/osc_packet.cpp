#include "drivers/datagram/osc_packet.h"

#include <algorithm>
#include <bit>
#include <optional>

namespace gazeloop::drivers::datagram {
namespace {

using Bytes = std::span<const std::uint8_t>;

constexpr std::string_view kBundle = "#bundle";
constexpr std::size_t kTimeTag = 8;

/// Numbers are big-endian.
std::optional<std::uint64_t> take_bits(Bytes& bytes, std::size_t size) {
    if (bytes.size() < size) {
        return std::nullopt;
    }
    std::uint64_t bits = 0;
    for (const std::uint8_t byte : bytes.first(size)) {
        bits = bits << 8U | byte;
    }
    bytes = bytes.subspan(size);
    return bits;
}

/// Ends with a zero, and fills words of four bytes.
std::optional<std::string_view> take_text(Bytes& bytes) {
    const auto end = std::ranges::find(bytes, std::uint8_t{0});
    if (end == bytes.end()) {
        return std::nullopt;
    }
    const auto length = static_cast<std::size_t>(end - bytes.begin());
    const std::size_t filled = (length / 4 + 1) * 4;
    if (filled > bytes.size()) {
        return std::nullopt;
    }
    const std::string_view text(reinterpret_cast<const char*>(bytes.data()), length);
    bytes = bytes.subspan(filled);
    return text;
}

std::optional<double> take_number(Bytes& bytes, char type) {
    switch (type) {
        case 'i':
            if (const auto bits = take_bits(bytes, 4)) {
                return static_cast<std::int32_t>(static_cast<std::uint32_t>(*bits));
            }
            return std::nullopt;
        case 'f':
            if (const auto bits = take_bits(bytes, 4)) {
                return std::bit_cast<float>(static_cast<std::uint32_t>(*bits));
            }
            return std::nullopt;
        case 'h':
            if (const auto bits = take_bits(bytes, 8)) {
                return static_cast<double>(static_cast<std::int64_t>(*bits));
            }
            return std::nullopt;
        case 'd':
            if (const auto bits = take_bits(bytes, 8)) {
                return std::bit_cast<double>(*bits);
            }
            return std::nullopt;
        case 'T':
            return 1.0;
        case 'F':
            return 0.0;
        default:
            return std::nullopt;
    }
}

/// False where it is no message.
bool parse_message(Bytes bytes, OscMessage& message) {
    message.count = 0;
    const auto address = take_text(bytes);
    if (!address || address->empty() || address->front() != '/') {
        return false;
    }
    message.address = *address;
    if (bytes.empty()) {
        return true;  // of a sender of before there were types
    }
    const auto types = take_text(bytes);
    if (!types || types->empty() || types->front() != ',') {
        return false;
    }
    const std::string_view numbers = types->substr(1);
    const bool taken = numbers.size() <= OscMessage::kMostArguments &&
                       numbers.find_first_not_of("ifhdTF") == std::string_view::npos;
    for (const char type : taken ? numbers : std::string_view()) {
        const auto number = take_number(bytes, type);
        if (!number) {
            return false;
        }
        message.arguments[message.count++] = *number;
    }
    return true;
}

}  // namespace

bool OscReader::refuse() {
    damaged_ = true;
    depth_ = 0;
    whole_ = false;
    rest_[0] = {};
    return false;
}

bool OscReader::next(OscMessage& message) {
    for (;;) {
        while (depth_ > 0 && rest_[static_cast<std::size_t>(depth_)].empty()) {
            --depth_;
        }
        Bytes& rest = rest_[static_cast<std::size_t>(depth_)];
        if (rest.empty()) {
            return whole_ ? refuse() : false;
        }
        Bytes element = rest;
        if (whole_) {
            rest = {};
            whole_ = false;
        } else {
            const auto size = take_bits(rest, 4);
            if (!size || *size % 4 != 0 || *size > rest.size()) {
                return refuse();
            }
            element = rest.first(static_cast<std::size_t>(*size));
            rest = rest.subspan(static_cast<std::size_t>(*size));
        }
        Bytes inside = element;
        if (take_text(inside) != kBundle) {
            return parse_message(element, message) || refuse();
        }
        if (inside.size() < kTimeTag || depth_ == kDeepest) {
            return refuse();
        }
        rest_[static_cast<std::size_t>(++depth_)] = inside.subspan(kTimeTag);
    }
}

}  // namespace gazeloop::drivers::datagram
