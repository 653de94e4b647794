#pragma once

#include <chrono>
#include <filesystem>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace gazeloop::tests {

struct ProgramResult {
    int exit_code = -1;  ///< 128 + signal where one killed it
    std::string out;
    std::string err;
};

struct ProgramOptions {
    /// Added to the environment{}; an empty value removes the variable.
    std::vector<std::pair<std::string, std::string>> environment{};
    /// Words before the program, "unshare -m ..."; looked up in PATH.
    std::vector<std::string> wrapper{};
    std::chrono::seconds timeout{120};  ///< then it is killed and the result says 137
    /// Called with the process id as soon as its output contains `trigger`.
    std::string trigger{};
    std::function<void(int pid)> on_trigger{};
};

/// Runs a program with its arguments, no standard input. The first word is its path, or its name in
/// PATH.
ProgramResult run_program(const std::vector<std::string>& command,
                          const ProgramOptions& options = {});

/// The same with the gazeloop program of this build and these arguments.
ProgramResult run_gazeloop(const std::vector<std::string>& arguments,
                           const ProgramOptions& options = {});

/// A fresh folder for one test, removed when it goes out of scope.
class ScratchFolder {
  public:
    ScratchFolder();
    ~ScratchFolder();
    ScratchFolder(const ScratchFolder&) = delete;
    ScratchFolder& operator=(const ScratchFolder&) = delete;

    [[nodiscard]] std::string file(const std::string& name) const {
        return (path_ / name).string();
    }
    [[nodiscard]] bool empty() const { return std::filesystem::is_empty(path_); }
    /// Writes a file and gives its path.
    [[nodiscard]] std::string write(const std::string& name, const std::string& text) const;

  private:
    std::filesystem::path path_;
};

}  // namespace gazeloop::tests
