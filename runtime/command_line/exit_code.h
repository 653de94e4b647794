#pragma once

#include <optional>

#include "runtime/error.h"

namespace gazeloop::cli {

/// The program's exit codes.
enum class ExitCode : int {
    Ok = 0,
    GateFailed = 1,
    Usage = 2,
    BadInput = 3,  ///< or a place where results cannot be written, stdout among them
    NoDevice = 4,
    SessionLost = 5,
    RecordingIncomplete = 6,
    Interrupted = 130,
};

[[nodiscard]] constexpr ExitCode exit_code(ErrorKind kind) {
    switch (kind) {
        case ErrorKind::GateFailed:
            return ExitCode::GateFailed;
        case ErrorKind::Usage:
            return ExitCode::Usage;
        case ErrorKind::BadInput:
            return ExitCode::BadInput;
        case ErrorKind::NoDevice:
            return ExitCode::NoDevice;
        case ErrorKind::SessionLost:
            return ExitCode::SessionLost;
        case ErrorKind::RecordingIncomplete:
            return ExitCode::RecordingIncomplete;
        case ErrorKind::Interrupted:
            return ExitCode::Interrupted;
    }
    return ExitCode::GateFailed;
}

/// None: nothing went wrong.
[[nodiscard]] constexpr ExitCode exit_code(std::optional<ErrorKind> kind) {
    return kind ? exit_code(*kind) : ExitCode::Ok;
}

}  // namespace gazeloop::cli
