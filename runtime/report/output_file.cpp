#include "runtime/report/output_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <optional>
#include <string>
#include <system_error>

namespace gazeloop::report {
namespace {

namespace fs = std::filesystem;

std::unexpected<Error> refuse(const fs::path& file, int error) {
    return std::unexpected(
        Error{ErrorKind::BadInput, fmt::format("{}: cannot be written ({})", file.string(),
                                               std::generic_category().message(error))});
}

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// What a name stands for: links are followed.
fs::path followed(const fs::path& file) {
    std::error_code failure;
    const fs::path real = fs::weakly_canonical(file, failure);
    return failure ? file : real;
}

/// 0, or the system's error.
int write_all(int descriptor, std::string_view text) {
    while (!text.empty()) {
        const ssize_t written = ::write(descriptor, text.data(), text.size());
        if (written < 0 && errno == EINTR) {
            continue;
        }
        if (written <= 0) {
            return written < 0 ? errno : EIO;
        }
        text.remove_prefix(static_cast<std::size_t>(written));
    }
    return 0;
}

int write_and_close(int descriptor, std::string_view text) {
    const int error = write_all(descriptor, text);
    return ::close(descriptor) != 0 && error == 0 ? errno : error;
}

int write_in_place(const fs::path& file, std::string_view text) {
    const int descriptor = ::open(file.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    return descriptor < 0 ? errno : write_and_close(descriptor, text);
}

/// The system's error, 0 if none, or nothing where there can be no file beside this one.
std::optional<int> replace(const fs::path& file, std::string_view text) {
    const std::string beside = fmt::format("{}.partial-{}", file.string(), ::getpid());
    const int descriptor = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
    if (descriptor < 0) {
        return std::nullopt;
    }
    struct stat before{};
    if (::stat(file.c_str(), &before) == 0) {
        ::fchmod(descriptor, before.st_mode & 0777U);
    }
    int error = write_and_close(descriptor, text);
    if (error == 0 && ::rename(beside.c_str(), file.c_str()) != 0) {
        error = errno;
    }
    if (error != 0) {
        ::unlink(beside.c_str());
    }
    return error;
}

}  // namespace

Expected<void> check_output(const fs::path& file) {
    if (file == "-") {
        return {};
    }
    std::error_code ignored;
    const fs::path real = followed(file);
    if (fs::is_directory(real, ignored)) {
        return refuse(file, EISDIR);
    }
    const bool there = fs::exists(real, ignored);
    const fs::path folder = folder_of(real);
    if (!there && !fs::is_directory(folder, ignored)) {
        return refuse(file, fs::exists(folder, ignored) ? ENOTDIR : ENOENT);
    }
    if (::access(there ? real.c_str() : folder.c_str(), there ? W_OK : W_OK | X_OK) != 0) {
        return refuse(file, errno);
    }
    return {};
}

Expected<void> write_text(const fs::path& file, std::string_view text) {
    if (file == "-") {
        if (std::fwrite(text.data(), 1, text.size(), stdout) != text.size()) {
            return refuse(file, errno);
        }
        return {};
    }
    if (auto writable = check_output(file); !writable) {
        return writable;
    }
    const fs::path real = followed(file);
    std::error_code ignored;
    std::optional<int> error;
    if (!fs::exists(real, ignored) || fs::is_regular_file(real, ignored)) {
        error = replace(real, text);
    }
    if (!error) {
        error = write_in_place(real, text);
    }
    if (*error != 0) {
        return refuse(file, *error);
    }
    return {};
}

}  // namespace gazeloop::report
