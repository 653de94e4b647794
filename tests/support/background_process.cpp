#include "tests/support/background_process.h"

#include <fcntl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <array>
#include <csignal>
#include <cstdlib>
#include <fstream>
#include <iterator>
#include <stdexcept>
#include <thread>

namespace gazeloop::tests {
namespace {

constexpr std::chrono::milliseconds kPoll{20};

[[noreturn]] void become(const BackgroundProcess::Options& options, int input) {
    const int output = open(options.output_file.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0600);
    dup2(input >= 0 ? input : open("/dev/null", O_RDONLY), STDIN_FILENO);
    dup2(output, STDOUT_FILENO);
    dup2(output, STDERR_FILENO);
    for (const auto& [name, value] : options.environment) {
        if (value.empty()) {
            unsetenv(name.c_str());
        } else {
            setenv(name.c_str(), value.c_str(), 1);
        }
    }
    std::vector<std::string> words = options.command;
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

BackgroundProcess::BackgroundProcess(const Options& options) : output_file_(options.output_file) {
    std::array<int, 2> input{-1, -1};
    if (options.with_input && pipe2(input.data(), O_CLOEXEC) != 0) {
        throw std::runtime_error("no pipe");
    }
    pid_ = fork();
    if (pid_ == 0) {
        become(options, input[0]);
    }
    if (input[0] >= 0) {
        close(input[0]);
    }
    input_ = input[1];
}

BackgroundProcess::~BackgroundProcess() {
    if (!ended()) {
        signal(SIGTERM);  // lets it clean up, where it does
        if (wait(std::chrono::seconds(5)) < 0) {
            signal(SIGKILL);
            waitpid(pid_, nullptr, 0);
        }
    }
    if (input_ >= 0) {
        close(input_);
    }
}

bool BackgroundProcess::says(const std::string& text, std::chrono::seconds timeout) {
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    while (output().find(text) == std::string::npos) {
        if (ended() || std::chrono::steady_clock::now() > deadline) {
            return false;
        }
        std::this_thread::sleep_for(kPoll);
    }
    return true;
}

void BackgroundProcess::signal(int number) const { kill(pid_, number); }

void BackgroundProcess::write(const std::string& text) const {
    if (::write(input_, text.data(), text.size()) != static_cast<ssize_t>(text.size())) {
        throw std::runtime_error("the program reads no input");
    }
}

int BackgroundProcess::wait(std::chrono::seconds timeout) {
    const auto deadline = std::chrono::steady_clock::now() + timeout;
    while (!ended() && std::chrono::steady_clock::now() < deadline) {
        std::this_thread::sleep_for(kPoll);
    }
    return exit_code_;
}

std::string BackgroundProcess::output() const {
    std::ifstream file(output_file_);
    return {std::istreambuf_iterator<char>(file), std::istreambuf_iterator<char>()};
}

bool BackgroundProcess::ended() {
    int status = 0;
    if (exit_code_ < 0 && waitpid(pid_, &status, WNOHANG) == pid_) {
        exit_code_ = WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status);
    }
    return exit_code_ >= 0;
}

}  // namespace gazeloop::tests
