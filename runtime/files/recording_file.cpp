#include "runtime/files/recording_file.h"

#include <algorithm>
#include <array>
#include <fstream>
#include <string>
#include <string_view>
#include <system_error>

namespace gazeloop::files {

bool begins_as_recording(const std::filesystem::path& file) {
    std::error_code ignored;
    if (!std::filesystem::is_regular_file(file, ignored)) {
        return false;  // reading a pipe would take from it
    }
    constexpr std::string_view kMagic{"SQLite format 3\0", 16};
    std::array<char, kMagic.size()> begin{};
    std::ifstream stream(file, std::ios::binary);
    stream.read(begin.data(), begin.size());
    return stream && std::string_view(begin.data(), begin.size()) == kMagic;
}

bool belongs_to_recording(const std::filesystem::path& file) {
    constexpr std::array<std::string_view, 3> kBeside{"-wal", "-shm", "-journal"};
    const std::string name = file.string();
    return begins_as_recording(file) || std::ranges::any_of(kBeside, [&](std::string_view end) {
               return name.ends_with(end) &&
                      begins_as_recording(name.substr(0, name.size() - end.size()));
           });
}

}  // namespace gazeloop::files
