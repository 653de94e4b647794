#include "runtime/scene/gltf/resource.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>

#include "runtime/memory/large_pages.h"
#include "runtime/open_for_reading.h"

namespace gazeloop::scene::gltf {
namespace {

/// For messages: what could be a megabyte of base64.
std::string shortened(std::string_view text) {
    constexpr std::size_t kMost = 100;
    return text.size() <= kMost ? std::string(text) : std::string(text.substr(0, kMost)) + "...";
}

char lower(char c) { return static_cast<char>(std::tolower(static_cast<unsigned char>(c))); }

bool starts_with_any_case(std::string_view text, std::string_view prefix) {
    return text.size() >= prefix.size() &&
           std::ranges::equal(text.substr(0, prefix.size()), prefix,
                              [](char a, char b) { return lower(a) == b; });
}

bool has_scheme(std::string_view uri) {
    const std::size_t colon = uri.find_first_of(":/?#");
    return colon != std::string_view::npos && uri[colon] == ':' && colon > 0;
}

int hex_digit(char c) {
    return c >= '0' && c <= '9'   ? c - '0'
           : c >= 'a' && c <= 'f' ? c - 'a' + 10
           : c >= 'A' && c <= 'F' ? c - 'A' + 10
                                  : -1;
}

std::string percent_decoded(std::string_view text, const std::string& place) {
    std::string decoded;
    decoded.reserve(text.size());
    for (std::size_t i = 0; i < text.size(); ++i) {
        if (text[i] != '%') {
            decoded += text[i];
            continue;
        }
        const int high = i + 2 < text.size() ? hex_digit(text[i + 1]) : -1;
        const int low = i + 2 < text.size() ? hex_digit(text[i + 2]) : -1;
        if (high < 0 || low < 0) {
            refuse(place, fmt::format("'{}': % must be followed by two hexadecimal digits",
                                      shortened(text)));
        }
        decoded += static_cast<char>(high * 16 + low);
        i += 2;
    }
    return decoded;
}

constexpr std::array<std::int8_t, 256> base64_values() {
    std::array<std::int8_t, 256> values{};
    values.fill(-1);
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    for (std::size_t i = 0; i < kDigits.size(); ++i) {
        values[static_cast<unsigned char>(kDigits[i])] = static_cast<std::int8_t>(i);
    }
    return values;
}

Bytes base64_decoded(std::string_view text, std::uint64_t most_bytes, const std::string& place) {
    static constexpr std::array<std::int8_t, 256> kValues = base64_values();
    while (text.ends_with('=')) {
        text.remove_suffix(1);
    }
    if (text.size() % 4 == 1) {
        refuse(place, "its base64 is cut short");
    }
    Bytes bytes;
    bytes.reserve(std::min<std::uint64_t>(most_bytes, text.size() / 4 * 3 + 3));
    std::uint32_t bits = 0;
    unsigned bit_count = 0;
    for (std::size_t i = 0; i < text.size() && bytes.size() < most_bytes; ++i) {
        const std::int8_t value = kValues[static_cast<unsigned char>(text[i])];
        if (value < 0) {
            refuse(place, fmt::format("its base64 has a byte {:#04x} at {}",
                                      static_cast<unsigned char>(text[i]), i));
        }
        bits = bits << 6U | static_cast<std::uint32_t>(value);
        bit_count += 6;
        if (bit_count >= 8) {
            bit_count -= 8;
            bytes.push_back(static_cast<std::byte>(bits >> bit_count));
        }
    }
    return bytes;
}

Bytes data_uri(std::string_view uri, std::uint64_t most_bytes, const std::string& place) {
    const std::size_t comma = uri.find(',');
    if (comma == std::string_view::npos) {
        refuse(place, fmt::format("'{}' is a data URI without a comma", shortened(uri)));
    }
    const std::string_view head = uri.substr(0, comma);
    const std::string_view body = uri.substr(comma + 1);
    constexpr std::string_view kBase64 = ";base64";
    if (head.size() >= kBase64.size() &&
        starts_with_any_case(head.substr(head.size() - kBase64.size()), kBase64)) {
        return base64_decoded(body, most_bytes, place);
    }
    const std::string decoded = percent_decoded(body, place);
    const std::size_t count = std::min<std::uint64_t>(decoded.size(), most_bytes);
    const auto* const first = reinterpret_cast<const std::byte*>(decoded.data());
    return {first, first + count};
}

}  // namespace

ReadFile files_of(const std::filesystem::path& folder) {
    return [folder](const std::string& path, std::uint64_t most_bytes, const std::string& place,
                    Bytes& bytes) {
        const std::filesystem::path file = folder / path;
        std::error_code ignored;
        if (std::filesystem::exists(file, ignored) &&
            !std::filesystem::is_regular_file(file, ignored)) {
            refuse(place, place.empty() ? "is no regular file"
                                        : fmt::format("{} is no regular file", file.string()));
        }
        auto in = open_for_reading(file);
        if (!in) {
            refuse(place,
                   place.empty()  // the scene itself, which its messages name
                       ? fmt::format("cannot be read ({}): name a .gltf or .glb file that is there",
                                     in.error())
                       : fmt::format("{} cannot be read ({}); keep it where the scene expects it",
                                     file.string(), in.error()));
        }
        const std::uint64_t there = std::filesystem::file_size(file, ignored);
        const std::size_t count = ignored ? 0 : std::min(there, most_bytes);
        // Steps, so that pictures of about one size are read into the same memory.
        constexpr std::size_t kStep = std::size_t{256} << 10U;
        bytes.clear();
        memory::reserve_in_large_pages(bytes, (count + kStep - 1) / kStep * kStep);
        bytes.resize(count);
        in->read(reinterpret_cast<char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
        bytes.resize(static_cast<std::size_t>(in->gcount()));
    };
}

void read_uri(std::string_view uri, std::uint64_t most_bytes, const std::string& place,
              const ReadFile& read_file, Notes& notes, Bytes& bytes) {
    if (starts_with_any_case(uri, "data:")) {
        bytes = data_uri(uri, most_bytes, place);
        return;
    }
    if (has_scheme(uri)) {
        refuse(place,
               fmt::format("'{}': only files beside the scene and data URIs are read; keep a "
                           "copy beside it",
                           shortened(uri)));
    }
    const std::string path = percent_decoded(uri, place);
    if (path.empty() || path.find('\0') != std::string::npos || path.starts_with('/')) {
        refuse(place,
               fmt::format("'{}' must be a path relative to the scene's file", shortened(uri)));
    }
    if (path.find('\\') != std::string::npos) {
        notes.add(
            "backslash", place,
            fmt::format("'{}' has a backslash, which is no separator of folders", shortened(uri)));
    }
    read_file(path, most_bytes, place, bytes);
}

std::vector<Buffer> read_buffers(const Document& document,
                                 std::optional<std::span<const std::byte>> binary,
                                 const ReadFile& read_file, Budget& budget, Notes& notes) {
    std::vector<Buffer> buffers(document.buffers.size());
    for (std::size_t i = 0; i < buffers.size(); ++i) {
        const BufferSource& source = document.buffers[i];
        const std::string place = fmt::format("/buffers/{}", i);
        Buffer& buffer = buffers[i];
        if (source.uri) {
            budget.take(source.bytes, place, "its bytes");
            read_uri(*source.uri, source.bytes, place + "/uri", read_file, notes, buffer.owned);
            buffer.bytes = buffer.owned;
        } else if (i == 0 && binary) {
            buffer.bytes = *binary;
        } else {
            refuse(place, binary ? "has no 'uri'; only the first buffer may be the binary chunk"
                                 : "has no 'uri', and the file has no binary chunk");
        }
        if (buffer.bytes.size() < source.bytes) {
            refuse(place,
                   fmt::format("must have {} bytes, has {}; its file may have been cut short",
                               source.bytes, buffer.bytes.size()));
        }
        constexpr std::uint64_t kMostPadding = 3;
        if (!source.uri && buffer.bytes.size() - source.bytes > kMostPadding) {
            notes.add("binary chunk", place,
                      fmt::format("has {} bytes, the binary chunk {}: the rest is left out",
                                  source.bytes, buffer.bytes.size()));
        }
        buffer.bytes = buffer.bytes.first(source.bytes);
    }
    if (binary && (document.buffers.empty() || document.buffers.front().uri)) {
        notes.add("unused binary chunk", "", "its binary chunk belongs to no buffer");
    }
    return buffers;
}

std::span<const std::byte> bytes_of(const Document& document, const std::vector<Buffer>& buffers,
                                    std::uint32_t view) {
    const BufferView& at = document.views.at(view);
    return buffers.at(at.buffer).bytes.subspan(at.offset, at.bytes);
}

}  // namespace gazeloop::scene::gltf
