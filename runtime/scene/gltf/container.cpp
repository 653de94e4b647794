#include "runtime/scene/gltf/container.h"

#include <fmt/format.h>

#include <cstdint>
#include <cstring>

namespace gazeloop::scene::gltf {
namespace {

constexpr std::uint32_t kMagic = 0x46546C67;   // "glTF"
constexpr std::uint32_t kJson = 0x4E4F534A;    // "JSON"
constexpr std::uint32_t kBinary = 0x004E4942;  // "BIN"
constexpr std::size_t kHeaderBytes = 12;
constexpr std::size_t kChunkHeaderBytes = 8;

/// Little-endian. Precondition: it lies inside.
std::uint32_t word_at(std::span<const std::byte> bytes, std::size_t offset) {
    std::uint32_t word = 0;
    for (std::size_t i = 0; i < 4; ++i) {
        word |= std::to_integer<std::uint32_t>(bytes[offset + i]) << (8 * i);
    }
    return word;
}

std::string_view text_of(std::span<const std::byte> bytes) {
    return {reinterpret_cast<const char*>(bytes.data()), bytes.size()};
}

struct Chunk {
    std::uint32_t type = 0;
    std::span<const std::byte> bytes;
};

/// The chunk at `offset`, which is moved on.
Chunk take_chunk(std::span<const std::byte> file, std::size_t& offset, Notes& notes) {
    if (file.size() - offset < kChunkHeaderBytes) {
        refuse("",
               fmt::format("ends inside a chunk's header at byte {}; it may have been cut short",
                           offset));
    }
    const std::uint32_t bytes = word_at(file, offset);
    const std::uint32_t type = word_at(file, offset + 4);
    const std::size_t begin = offset + kChunkHeaderBytes;
    if (bytes > file.size() - begin) {
        refuse("",
               fmt::format("a chunk at byte {} has {} bytes, of which {} are there; it may have "
                           "been cut short",
                           offset, bytes, file.size() - begin));
    }
    if (bytes % 4 != 0) {
        notes.add("chunk alignment", "",
                  fmt::format("a chunk at byte {} has {} bytes, no multiple of 4", offset, bytes));
    }
    offset = begin + bytes;
    return {type, file.subspan(begin, bytes)};
}

}  // namespace

Container open_container(std::span<const std::byte> file, Notes& notes) {
    if (file.size() < 4 || word_at(file, 0) != kMagic) {
        return {text_of(file), std::nullopt};
    }
    if (file.size() < kHeaderBytes) {
        refuse("", "ends inside its header; it may have been cut short");
    }
    if (const std::uint32_t version = word_at(file, 4); version != 2) {
        refuse("", fmt::format("is a .glb of version {}: only 2 can be read; export the scene as "
                               "glTF 2.0",
                               version));
    }
    const std::uint32_t length = word_at(file, 8);
    if (length > file.size() || length < kHeaderBytes) {
        refuse("", fmt::format("says it has {} bytes and has {}; it may have been cut short",
                               length, file.size()));
    }
    if (length < file.size()) {
        notes.add("glb length", "",
                  fmt::format("has {} bytes after its end: left out", file.size() - length));
        file = file.first(length);
    }
    std::size_t offset = kHeaderBytes;
    const Chunk first = take_chunk(file, offset, notes);
    if (first.type != kJson) {
        refuse("", "its first chunk is not JSON");
    }
    Container parts{text_of(first.bytes), std::nullopt};
    while (offset < file.size()) {
        const Chunk chunk = take_chunk(file, offset, notes);
        if (chunk.type == kBinary && !parts.binary) {
            parts.binary = chunk.bytes;
        } else {
            notes.add(
                "chunk", "",
                fmt::format("a chunk of type {:#010x} has no meaning here: left out", chunk.type));
        }
    }
    return parts;
}

}  // namespace gazeloop::scene::gltf
