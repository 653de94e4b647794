#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/scene/gltf/document.h"
#include "runtime/scene/gltf/load_limits.h"

namespace gazeloop::scene::gltf {

using Bytes = std::vector<std::byte>;

/// Reads at most the first `most_bytes` of the file at a decoded relative path into `bytes`, which
/// may be full of another: its memory is used again. Throws Refusal, whose place the caller gives.
using ReadFile = std::function<void(const std::string& path, std::uint64_t most_bytes,
                                    const std::string& place, Bytes& bytes)>;

/// Reads regular files of a folder and below.
[[nodiscard]] ReadFile files_of(const std::filesystem::path& folder);

/// What a URI holds, at most its first `most_bytes`: a data URI's (RFC 2397, any case), or that of
/// a file that lies relative to the scene's (percent-encoding is decoded, `+` is a plus). Schemes
/// and absolute paths are refused. Into `bytes`, as ReadFile.
void read_uri(std::string_view uri, std::uint64_t most_bytes, const std::string& place,
              const ReadFile& read_file, Notes& notes, Bytes& bytes);

/// A buffer's bytes: its own, or part of the .glb.
struct Buffer {
    Bytes owned;
    std::span<const std::byte> bytes;
};

/// All of a document's buffers, each with as many bytes as it says.
[[nodiscard]] std::vector<Buffer> read_buffers(const Document& document,
                                               std::optional<std::span<const std::byte>> binary,
                                               const ReadFile& read_file, Budget& budget,
                                               Notes& notes);

/// The bytes of a view.
[[nodiscard]] std::span<const std::byte> bytes_of(const Document& document,
                                                  const std::vector<Buffer>& buffers,
                                                  std::uint32_t view);

}  // namespace gazeloop::scene::gltf
