#include "runtime/files/output_file.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <string>
#include <system_error>
#include <utility>

#include "runtime/files/recording_file.h"

namespace gazeloop::files {
namespace {

namespace fs = std::filesystem;

std::unexpected<Error> refuse(const fs::path& file, std::string_view why) {
    return std::unexpected(Error{
        ErrorKind::BadInput,
        fmt::format("{}: cannot be written ({})", file == "-" ? "stdout" : file.string(), why)});
}

std::unexpected<Error> refuse(const fs::path& file, int error) {
    return refuse(file, std::generic_category().message(error));
}

/// A reader who has closed stdout wants no more of it, which is no error: other results are still
/// written, and the program's end deals with it.
Expected<void> stdout_refused() { return errno == EPIPE ? Expected<void>{} : refuse("-", errno); }

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
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

/// A new file beside this one, that may take its place.
int open_beside(const fs::path& file, const std::string& beside, mode_t mode) {
    const int descriptor = ::open(beside.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, mode);
    struct stat before{};
    if (descriptor >= 0 && ::stat(file.c_str(), &before) == 0) {
        ::fchmod(descriptor, before.st_mode & mode);
    }
    return descriptor;
}

}  // namespace

fs::path followed(const fs::path& file) {
    std::error_code failure;
    const fs::path real = fs::weakly_canonical(file, failure);
    return failure ? file : real;
}

Expected<void> check_output(const fs::path& file) {
    if (file == "-") {
        return {};
    }
    std::error_code ignored;
    const fs::path real = followed(file);
    if (fs::is_directory(real, ignored)) {
        return refuse(file, EISDIR);
    }
    if (fs::is_socket(real, ignored) || fs::is_block_file(real, ignored)) {
        return refuse(file, fs::is_socket(real, ignored)
                                ? "it is a socket, not a file: name a file or a pipe"
                                : "it is a block device, not a file: name a file in it");
    }
    if (belongs_to_recording(real)) {
        return refuse(file,
                      "a recording is there, which cannot be had again: name another file, or "
                      "remove it");
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

OutputFile::OutputFile(fs::path file, fs::path real, std::string beside, int descriptor,
                       bool durable)
    : file_(std::move(file)),
      real_(std::move(real)),
      beside_(std::move(beside)),
      unfinished_(beside_.empty() ? nullptr : std::make_unique<UnfinishedFile>(beside_)),
      descriptor_(descriptor),
      durable_(durable) {}

OutputFile::OutputFile(OutputFile&& other) noexcept
    : file_(std::move(other.file_)),
      real_(std::move(other.real_)),
      beside_(std::exchange(other.beside_, {})),
      unfinished_(std::move(other.unfinished_)),
      descriptor_(std::exchange(other.descriptor_, -1)),
      durable_(other.durable_) {}

OutputFile::~OutputFile() { abandon(); }

Expected<OutputFile> OutputFile::open(const fs::path& file, const OutputOptions& options) {
    if (file == "-") {
        return OutputFile(file, file, {}, -1, false);
    }
    if (auto writable = check_output(file); !writable) {
        return std::unexpected(std::move(writable.error()));
    }
    const fs::path real = followed(file);
    std::error_code ignored;
    if (!fs::exists(real, ignored) || fs::is_regular_file(real, ignored)) {
        std::string beside = fmt::format("{}.partial-{}", real.string(), ::getpid());
        if (const int descriptor = open_beside(real, beside, options.mode); descriptor >= 0) {
            return OutputFile(file, real, std::move(beside), descriptor, options.durable);
        }
    }
    const int descriptor =
        ::open(real.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, options.mode);
    if (descriptor < 0) {
        return refuse(file, errno);
    }
    return OutputFile(file, real, {}, descriptor, false);
}

Expected<void> OutputFile::write(std::string_view text) {
    if (file_ == "-") {
        return std::fwrite(text.data(), 1, text.size(), stdout) == text.size() ? Expected<void>{}
                                                                               : stdout_refused();
    }
    if (const int error = write_all(descriptor_, text); error != 0) {
        abandon();
        return refuse(file_, error);
    }
    return {};
}

Expected<void> OutputFile::close() {
    if (file_ == "-") {
        return std::fflush(stdout) == 0 ? Expected<void>{} : stdout_refused();
    }
    int error = durable_ && ::fsync(descriptor_) != 0 ? errno : 0;
    if (::close(std::exchange(descriptor_, -1)) != 0 && error == 0) {
        error = errno;
    }
    if (error == 0 && !beside_.empty() && ::rename(beside_.c_str(), real_.c_str()) != 0) {
        error = errno;
    }
    if (error != 0) {
        abandon();
        return refuse(file_, error);
    }
    beside_.clear();
    unfinished_.reset();
    return {};
}

void OutputFile::abandon() {
    if (descriptor_ >= 0) {
        ::close(std::exchange(descriptor_, -1));
    }
    if (!beside_.empty()) {
        ::unlink(beside_.c_str());
        beside_.clear();
        unfinished_.reset();
    }
}

Expected<void> write_text(const fs::path& file, std::string_view text,
                          const OutputOptions& options) {
    Expected<OutputFile> output = OutputFile::open(file, options);
    if (!output) {
        return std::unexpected(std::move(output.error()));
    }
    if (auto written = output->write(text); !written) {
        return written;
    }
    return output->close();
}

}  // namespace gazeloop::files
