#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/doctor/checks.h"
#include "runtime/run/program_settings.h"

namespace gazeloop::run {

/// What of a machine is examined, beside what the settings say.
struct Examination {
    std::string folder = ".";  ///< where recordings are to go
    std::string root = "/";    ///< stands in for the machine's /sys and /dev
    double patience_s = 20.0;  ///< a driver or runtime that takes longer counts as hanging
    std::string json;          ///< "-": stdout; empty: not asked for
};

/// Loads every layer that is there and can be loaded, in order; `files_named` come last.
[[nodiscard]] doctor::Findings check_configuration(const std::vector<std::string>& files_named,
                                                   settings::Settings& settings);

/// Checks all that the loop needs, and says what it found after `findings`. None: the loop can run;
/// else NoDevice or Interrupted. @throws SetupError (BadInput) for a file that cannot be written
std::optional<ErrorKind> examine(const Examination& wanted, ProgramSettings& settings,
                                 doctor::Findings findings);

}  // namespace gazeloop::run
