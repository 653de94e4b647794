#include "tests/bench/measured_program.h"

#include <fcntl.h>
#include <fmt/ranges.h>
#include <sys/wait.h>
#include <unistd.h>

#include <chrono>
#include <fstream>
#include <stdexcept>
#include <thread>

namespace gazeloop::bench {
namespace {

[[noreturn]] void become(std::vector<std::string> command) {
    const int nowhere = open("/dev/null", O_RDWR);
    for (const int stream : {STDIN_FILENO, STDOUT_FILENO, STDERR_FILENO}) {
        dup2(nowhere, stream);
    }
    std::vector<char*> words;
    words.reserve(command.size() + 1);
    for (std::string& word : command) {
        words.push_back(word.data());
    }
    words.push_back(nullptr);
    execv(words[0], words.data());
    _exit(127);
}

/// The kernel's own mark of the most that a process has held since it became its program; 0 once it
/// has ended. (What wait4() tells counts our own memory too, from before that.)
std::uint64_t peak_bytes_of(pid_t pid) {
    std::ifstream status(fmt::format("/proc/{}/status", pid));
    for (std::string word; status >> word;) {
        std::uint64_t kilobytes = 0;
        if (word == "VmHWM:" && status >> kilobytes) {
            return 1024 * kilobytes;
        }
    }
    return 0;
}

}  // namespace

MeasuredProgram measure_program(const std::vector<std::string>& command) {
    constexpr std::chrono::milliseconds kLookEvery{2};
    MeasuredProgram measured;
    const auto begin = std::chrono::steady_clock::now();
    const pid_t pid = fork();
    if (pid == 0) {
        become(command);
    }
    int status = 0;
    while (waitpid(pid, &status, WNOHANG) == 0) {
        if (const std::uint64_t bytes = peak_bytes_of(pid); bytes > 0) {
            measured.peak_bytes = bytes;
        }
        std::this_thread::sleep_for(kLookEvery);
    }
    measured.seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
    if (!WIFEXITED(status) || WEXITSTATUS(status) != 0) {
        throw std::runtime_error(fmt::format("{} failed", fmt::join(command, " ")));
    }
    return measured;
}

}  // namespace gazeloop::bench
