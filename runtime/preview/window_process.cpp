#include "runtime/preview/window_process.h"

#include <fcntl.h>
#include <fmt/core.h>
#include <poll.h>
#include <spawn.h>
#include <sys/mman.h>
#include <sys/socket.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>
#include <new>
#include <string>

#include "runtime/error.h"
#include "runtime/preview/preview_window.h"

namespace gazeloop::preview {
namespace {

constexpr int kOpenPatienceMs = 20'000;
constexpr int kClosePatienceMs = 2'000;

SetupError refused(std::string_view why) {
    return {ErrorKind::NoDevice,
            fmt::format("--preview: {}; run it on a desktop or with DISPLAY naming an X server "
                        "(under Wayland: Xwayland; without a screen: xvfb-run), or leave --preview "
                        "out",
                        why)};
}

/// Closes a descriptor.
class Descriptor {
  public:
    explicit Descriptor(int fd) : fd_(fd) {}
    Descriptor(const Descriptor&) = delete;
    Descriptor& operator=(const Descriptor&) = delete;
    ~Descriptor() {
        if (fd_ >= 0) {
            close(fd_);
        }
    }
    [[nodiscard]] int get() const { return fd_; }

  private:
    int fd_;
};

}  // namespace

WindowProcess::WindowProcess(std::uint32_t eyes) {
    const Descriptor memory(memfd_create("gazeloop-preview", MFD_CLOEXEC));
    if (memory.get() < 0 || ftruncate(memory.get(), sizeof(PreviewMemory)) != 0) {
        throw refused(fmt::format("no shared memory ({})", std::strerror(errno)));
    }
    void* const mapped =
        mmap(nullptr, sizeof(PreviewMemory), PROT_READ | PROT_WRITE, MAP_SHARED, memory.get(), 0);
    if (mapped == MAP_FAILED) {
        throw refused(fmt::format("no shared memory ({})", std::strerror(errno)));
    }
    // Default-initialised: the pixels' pages stay untouched until there are pixels.
    memory_ = new (mapped) PreviewMemory;
    memory_->eyes = eyes;
    try {
        start(memory.get());
        wait_until_open();
    } catch (...) {
        end();
        throw;
    }
}

void WindowProcess::start(int memory) {
    std::array<int, 2> sockets{};
    if (socketpair(AF_UNIX, SOCK_STREAM | SOCK_CLOEXEC, 0, sockets.data()) != 0) {
        throw refused(fmt::format("no socket ({})", std::strerror(errno)));
    }
    socket_ = sockets[0];
    const Descriptor its_socket(sockets[1]);

    // Numbers out of the way, so that one inherited file does not take the other's place.
    const int least = std::max(kWindowMemoryFd, kWindowSocketFd) + 1;
    const Descriptor given_memory(fcntl(memory, F_DUPFD_CLOEXEC, least));
    const Descriptor given_socket(fcntl(its_socket.get(), F_DUPFD_CLOEXEC, least));
    posix_spawn_file_actions_t actions;
    posix_spawn_file_actions_init(&actions);
    posix_spawn_file_actions_adddup2(&actions, given_memory.get(), kWindowMemoryFd);
    posix_spawn_file_actions_adddup2(&actions, given_socket.get(), kWindowSocketFd);
    std::string program = "gazeloop";
    std::string command = kWindowCommand;
    std::array<char*, 3> arguments{program.data(), command.data(), nullptr};
    const int failure =
        posix_spawn(&pid_, "/proc/self/exe", &actions, nullptr, arguments.data(), environ);
    posix_spawn_file_actions_destroy(&actions);
    if (failure != 0) {
        pid_ = -1;
        throw refused(
            fmt::format("the window's process did not start ({})", std::strerror(failure)));
    }
}

/// It says "open", or why not.
void WindowProcess::wait_until_open() {
    std::string said;
    for (;;) {
        pollfd readable{socket_, POLLIN, 0};
        const int ready = poll(&readable, 1, kOpenPatienceMs);
        if (ready < 0 && errno == EINTR) {
            continue;
        }
        if (ready <= 0) {
            kill(pid_, SIGKILL);
            throw refused(
                fmt::format("the display did not answer within {} s", kOpenPatienceMs / 1000));
        }
        std::array<char, 512> buffer{};
        const ssize_t count = read(socket_, buffer.data(), buffer.size());
        if (count <= 0) {
            throw refused(said.empty() ? "the window's process ended at once" : said);
        }
        said.append(buffer.data(), static_cast<std::size_t>(count));
        if (said == kWindowIsOpen) {
            return;
        }
    }
}

WindowState WindowProcess::state() {
    int status = 0;
    if (state_ == WindowState::Open && waitpid(pid_, &status, WNOHANG) == pid_) {
        pid_ = -1;
        state_ = WIFEXITED(status) && WEXITSTATUS(status) == 0 ? WindowState::Closed
                                                               : WindowState::Broken;
    }
    return state_;
}

void WindowProcess::end() {
    if (socket_ >= 0) {
        close(socket_);  // which it sees, and ends
        socket_ = -1;
    }
    for (int waited_ms = 0; pid_ > 0 && waitpid(pid_, nullptr, WNOHANG) == 0; ++waited_ms) {
        if (waited_ms >= kClosePatienceMs) {
            kill(pid_, SIGKILL);
            waitpid(pid_, nullptr, 0);
            break;
        }
        poll(nullptr, 0, 1);
    }
    pid_ = -1;
    if (memory_ != nullptr) {
        munmap(memory_, sizeof(PreviewMemory));
        memory_ = nullptr;
    }
}

WindowProcess::~WindowProcess() { end(); }

}  // namespace gazeloop::preview
