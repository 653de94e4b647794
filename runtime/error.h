#pragma once

#include <cstdint>
#include <expected>
#include <stdexcept>
#include <string>
#include <type_traits>
#include <utility>

namespace gazeloop {

/// What went wrong, for whoever has to act on it. command_line/exit_code.h has the program's codes.
enum class ErrorKind : std::uint8_t {
    GateFailed,           ///< a budget, a quality gate or a replay comparison failed
    Usage,                ///< command line or configuration
    BadInput,             ///< a file's content; the message names file and line
    NoDevice,             ///< no OpenXR runtime, no Vulkan device
    SessionLost,          ///< the runtime or the device went away
    RecordingIncomplete,  ///< finished, but the recording lacks something
    Interrupted,          ///< SIGINT or SIGTERM; everything recorded is kept
};

/// An error for a person: the message names the thing, the place and the remedy.
struct Error {
    ErrorKind kind = ErrorKind::BadInput;
    std::string message;
};

template <typename T>
using Expected = std::expected<T, Error>;

/// Thrown where set-up cannot go on; the program turns it into message and exit code.
class SetupError : public std::runtime_error {
  public:
    explicit SetupError(const Error& error)
        : std::runtime_error(error.message), kind_(error.kind) {}
    SetupError(ErrorKind kind, const std::string& message)
        : std::runtime_error(message), kind_(kind) {}
    [[nodiscard]] ErrorKind kind() const { return kind_; }

  private:
    ErrorKind kind_;
};

/// The value, or a SetupError with the error's message and kind.
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
