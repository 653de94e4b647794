#include "runtime/run/line_writer.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <sys/socket.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <charconv>
#include <climits>
#include <system_error>

namespace gazeloop::run {
namespace {

std::string reason() { return std::generic_category().message(errno); }

/// Whether at least PIPE_BUF bytes find room in a pipe, or any in something else.
bool has_room(int fd, int patience_ms) {
    pollfd one{fd, POLLOUT, 0};
    return poll(&one, 1, patience_ms) > 0;  // errors too: the writing then names them
}

ssize_t write_some(int fd, const char* bytes, std::size_t size) {
    const ssize_t sent = send(fd, bytes, size, MSG_DONTWAIT | MSG_NOSIGNAL);
    return sent < 0 && errno == ENOTSOCK ? ::write(fd, bytes, size) : sent;
}

}  // namespace

std::string LineWriter::refusal(int fd) {
    const int flags = fcntl(fd, F_GETFL);
    if (flags < 0) {
        return fmt::format(
            "file descriptor {} is not open ({}): open it for the program, e.g. "
            "{}>FILE or {}> >(PROGRAM)",
            fd, reason(), fd, fd);
    }
    if ((flags & O_ACCMODE) == O_RDONLY || (flags & O_PATH) != 0) {
        return fmt::format("file descriptor {} is not open for writing", fd);
    }
    return {};
}

std::string LineWriter::refusal(std::string_view text) {
    int fd = -1;
    const char* const end = text.data() + text.size();
    const auto [stopped, error] = std::from_chars(text.data(), end, fd);
    return error != std::errc{} || stopped != end || fd < 0
               ? fmt::format("'{}' must be the number of a file descriptor", text)
               : refusal(fd);
}

LineWriter::LineWriter(int fd) : fd_(fd) {
    if (fd > STDERR_FILENO) {
        (void)fcntl(fd, F_SETFD, FD_CLOEXEC);
    }
}

bool LineWriter::write(std::string_view line, int patience_ms) {
    go_on(patience_ms);
    if (broken() || !rest_.empty() || !has_room(fd_, patience_ms)) {
        ++dropped_;
        return false;
    }
    rest_ = line;
    rest_ += '\n';
    go_on(0);
    if (broken()) {
        ++dropped_;
        return false;
    }
    ++written_;
    return true;
}

void LineWriter::finish(int patience_ms) { go_on(patience_ms); }

void LineWriter::go_on(int patience_ms) {
    while (!rest_.empty() && !broken() && has_room(fd_, patience_ms)) {
        const ssize_t done =
            write_some(fd_, rest_.data(), std::min(rest_.size(), std::size_t{PIPE_BUF}));
        if (done > 0) {
            rest_.erase(0, static_cast<std::size_t>(done));
        } else if (errno == EAGAIN) {
            return;
        } else if (errno != EINTR) {
            why_broken_ = reason();
        }
    }
}

}  // namespace gazeloop::run
