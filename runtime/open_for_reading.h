#pragma once

#include <cerrno>
#include <cstring>
#include <expected>
#include <filesystem>
#include <fstream>
#include <string>

namespace gazeloop {

/// A file's content. Errors: why it has none, "No such file or directory".
inline std::expected<std::ifstream, std::string> open_for_reading(
    const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::is_directory(file, ignored)) {  // which could be opened
        return std::unexpected("it is a folder");
    }
    errno = 0;
    std::ifstream in(file, std::ios::binary);
    if (!in) {
        return std::unexpected(std::strerror(errno));
    }
    return in;
}

/// The same of a regular file alone: of others, reading may never end.
inline std::expected<std::ifstream, std::string> open_regular_file(
    const std::filesystem::path& file) {
    std::error_code ignored;
    if (std::filesystem::exists(file, ignored) &&
        !std::filesystem::is_regular_file(file, ignored) &&
        !std::filesystem::is_directory(file, ignored)) {
        return std::unexpected("it is no regular file");
    }
    return open_for_reading(file);
}

}  // namespace gazeloop
