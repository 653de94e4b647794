#include "runtime/openxr_layer/private_file.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <system_error>

namespace gazeloop::openxr_layer {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kOwnerOnly = 0600;

bool make_folder(const fs::path& folder) {
    std::error_code failure;
    if (fs::is_directory(folder, failure)) {
        return true;
    }
    fs::create_directories(folder, failure);
    if (failure) {
        return false;
    }
    fs::permissions(folder, fs::perms::owner_all, failure);
    return true;
}

bool write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno != EINTR) {
            return false;
        }
        text.remove_prefix(written > 0 ? static_cast<std::size_t>(written) : 0);
    }
    return true;
}

bool write_to(const fs::path& file, std::string_view text, int flags) {
    const int descriptor =
        ::open(file.c_str(), O_WRONLY | O_CREAT | O_CLOEXEC | O_NOFOLLOW | flags, kOwnerOnly);
    if (descriptor < 0) {
        return false;
    }
    const bool written = ::fchmod(descriptor, kOwnerOnly) == 0 && write_all(descriptor, text);
    return ::close(descriptor) == 0 && written;
}

}  // namespace

bool write_private(const fs::path& file, std::string_view text) {
    if (!make_folder(file.parent_path())) {
        return false;
    }
    // Of this process alone, so that two of them do not write into one.
    const fs::path beside = fmt::format("{}.{}", file.string(), ::getpid());
    std::error_code failure;
    if (!write_to(beside, text, O_TRUNC)) {
        fs::remove(beside, failure);
        return false;
    }
    fs::rename(beside, file, failure);
    return !failure;
}

bool append_private(const fs::path& file, std::string_view text, std::size_t most) {
    if (!make_folder(file.parent_path())) {
        return false;
    }
    std::error_code failure;
    if (const auto size = fs::file_size(file, failure); !failure && size > most) {
        fs::rename(file, file.string() + ".old", failure);
    }
    return write_to(file, text, O_APPEND);
}

std::optional<std::string> read_small(const fs::path& file, std::size_t most) {
    std::error_code failure;
    if (!fs::is_regular_file(file, failure) || fs::file_size(file, failure) > most || failure) {
        return std::nullopt;
    }
    std::ifstream in(file, std::ios::binary);
    std::string text(std::istreambuf_iterator<char>(in), {});
    return in.bad() || text.size() > most ? std::nullopt : std::optional(std::move(text));
}

}  // namespace gazeloop::openxr_layer
