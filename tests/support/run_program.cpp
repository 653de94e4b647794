#include "tests/support/run_program.h"

#include <fcntl.h>
#include <poll.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <stdexcept>

namespace gazeloop::tests {
namespace {

[[noreturn]] void become(const std::vector<std::string>& command, const ProgramOptions& options,
                         int out, int err) {
    dup2(open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(out, STDOUT_FILENO);
    dup2(err, STDERR_FILENO);
    for (const auto& [name, value] : options.environment) {
        if (value.empty()) {
            unsetenv(name.c_str());
        } else {
            setenv(name.c_str(), value.c_str(), 1);
        }
    }
    std::vector<std::string> words = options.wrapper;
    words.insert(words.end(), command.begin(), command.end());
    std::vector<char*> pointers;
    pointers.reserve(words.size() + 1);
    for (std::string& word : words) {
        pointers.push_back(word.data());
    }
    pointers.push_back(nullptr);
    execvp(pointers[0], pointers.data());
    _exit(127);
}

}  // namespace

ProgramResult run_program(const std::vector<std::string>& command, const ProgramOptions& options) {
    std::array<int, 2> out{};
    std::array<int, 2> err{};
    if (pipe2(out.data(), O_CLOEXEC) != 0 || pipe2(err.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error("no pipe");
    }
    const pid_t pid = fork();
    if (pid == 0) {
        become(command, options, out[1], err[1]);
    }
    close(out[1]);
    close(err[1]);
    ProgramResult result;
    const auto deadline = std::chrono::steady_clock::now() + options.timeout;
    std::array<pollfd, 2> streams{pollfd{out[0], POLLIN, 0}, pollfd{err[0], POLLIN, 0}};
    bool triggered = options.trigger.empty();
    int open_streams = 2;
    while (open_streams > 0) {
        if (std::chrono::steady_clock::now() > deadline) {
            kill(pid, SIGKILL);
        }
        poll(streams.data(), streams.size(), 100);
        for (std::size_t i = 0; i < streams.size(); ++i) {
            if ((streams[i].revents & (POLLIN | POLLHUP)) == 0) {
                continue;
            }
            std::array<char, 4096> buffer{};
            const ssize_t count = read(streams[i].fd, buffer.data(), buffer.size());
            if (count <= 0) {
                close(streams[i].fd);
                streams[i].fd = -1;
                streams[i].revents = 0;
                --open_streams;
                continue;
            }
            (i == 0 ? result.out : result.err)
                .append(buffer.data(), static_cast<std::size_t>(count));
        }
        if (!triggered && (result.out + result.err).find(options.trigger) != std::string::npos) {
            triggered = true;
            options.on_trigger(pid);
        }
    }
    int status = 0;
    waitpid(pid, &status, 0);
    result.exit_code = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    return result;
}

ProgramResult run_gazeloop(const std::vector<std::string>& arguments,
                           const ProgramOptions& options) {
    std::vector<std::string> command{std::string(GAZELOOP_BINARY_DIR) + "/gazeloop"};
    command.insert(command.end(), arguments.begin(), arguments.end());
    return run_program(command, options);
}

ScratchFolder::ScratchFolder() {
    std::string pattern = (std::filesystem::temp_directory_path() / "gazeloop-XXXXXX").string();
    if (mkdtemp(pattern.data()) == nullptr) {
        throw std::runtime_error("no scratch folder");
    }
    path_ = pattern;
}

ScratchFolder::~ScratchFolder() {
    std::error_code ignored;
    std::filesystem::remove_all(path_, ignored);
}

std::string ScratchFolder::write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
    return file(name);
}

}  // namespace gazeloop::tests
