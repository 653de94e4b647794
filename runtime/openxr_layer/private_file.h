#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace gazeloop::openxr_layer {

/// Replaces a file by a complete new one that only its owner can read (mode 0600), in a folder that
/// is made if it is not there (0700). Whether that succeeded.
bool write_private(const std::filesystem::path& file, std::string_view text);

/// Adds to such a file; where it has grown beyond `most` bytes, it becomes FILE.old first.
bool append_private(const std::filesystem::path& file, std::string_view text, std::size_t most);

/// A file's whole content; none where it cannot be read or is larger than `most` bytes.
std::optional<std::string> read_small(const std::filesystem::path& file, std::size_t most);

}  // namespace gazeloop::openxr_layer
