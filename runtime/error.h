#pragma once

#include <expected>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace gazeloop {

/// The program's exit codes.
enum class ExitCode : int {
    Ok = 0,
    GateFailed = 1,           ///< a budget, a quality gate or a replay comparison failed
    Usage = 2,                ///< command line or configuration
    BadInput = 3,             ///< a file's content; the message names file and line
    NoDevice = 4,             ///< no OpenXR runtime, no Vulkan device
    SessionLost = 5,          ///< the runtime or the device went away
    RecordingIncomplete = 6,  ///< finished, but the recording lacks something
    Interrupted = 130,        ///< SIGINT or SIGTERM; everything recorded is kept
};

/// An error for a person: the message names the thing, the place and the remedy.
struct Error {
    ExitCode code = ExitCode::BadInput;
    std::string message;
};

template <typename T>
using Expected = std::expected<T, Error>;

/// Thrown where set-up cannot go on; main turns it into message and exit code.
class SetupError : public std::runtime_error {
  public:
    explicit SetupError(const Error& error)
        : std::runtime_error(error.message), code_(error.code) {}
    SetupError(ExitCode code, const std::string& message)
        : std::runtime_error(message), code_(code) {}
    [[nodiscard]] ExitCode code() const { return code_; }

  private:
    ExitCode code_;
};

/// The value, or a SetupError with the error's message and code.
template <typename T>
T value_or_throw(Expected<T> expected) {
    if (!expected) {
        throw SetupError(expected.error());
    }
    if constexpr (!std::is_void_v<T>) {
        return std::move(*expected);
    }
}

}  // namespace gazeloop
