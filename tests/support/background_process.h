#pragma once

#include <sys/types.h>

#include <chrono>
#include <string>
#include <utility>
#include <vector>

namespace gazeloop::tests {

/// A program that runs beside a test, its output in a file; ended when it goes out of scope.
class BackgroundProcess {
  public:
    struct Options {
        std::vector<std::string> command;  ///< path or name, then arguments
        /// Added to the environment; an empty value removes the variable.
        std::vector<std::pair<std::string, std::string>> environment;
        std::string output_file;
        bool with_input = false;  ///< a pipe that write() fills; else no standard input
    };
    explicit BackgroundProcess(const Options& options);
    BackgroundProcess(const BackgroundProcess&) = delete;
    BackgroundProcess& operator=(const BackgroundProcess&) = delete;
    ~BackgroundProcess();

    /// Waits until the output holds the text. False: the time is over, or the program has ended.
    [[nodiscard]] bool says(const std::string& text, std::chrono::seconds timeout);

    void signal(int number) const;
    void write(const std::string& text) const;

    /// Waits for the end. The exit code, 128 + signal, or -1 where the time is over.
    int wait(std::chrono::seconds timeout);

    [[nodiscard]] std::string output() const;

  private:
    [[nodiscard]] bool ended();

    std::string output_file_;
    pid_t pid_ = -1;
    int input_ = -1;
    int exit_code_ = -1;
};

}  // namespace gazeloop::tests
