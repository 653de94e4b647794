#include "runtime/session/write_ahead_log.h"

#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <fstream>
#include <system_error>

namespace gazeloop::session {
namespace {

/// By SQLite's header.
bool is_in_wal_mode(const std::filesystem::path& file) {
    constexpr std::size_t kReadVersion = 19;
    constexpr char kWal = 2;
    std::array<char, kReadVersion + 1> header{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(header.data(), header.size());
    return stream && header[kReadVersion] == kWal;
}

}  // namespace

bool has_write_ahead_log(const std::filesystem::path& file) {
    std::error_code error;
    const std::uintmax_t bytes = std::filesystem::file_size(file.string() + "-wal", error);
    return !error && bytes > 0;
}

std::string missing_log(const std::filesystem::path& file) {
    if (has_write_ahead_log(file) || !is_in_wal_mode(file)) {
        return {};
    }
    return fmt::format(
        "its log {0}-wal, with what was recorded last or with all of it, is not beside it: copy "
        "{0}-wal from where the recording was made into the same folder and open it again",
        file.filename().string());
}

}  // namespace gazeloop::session
