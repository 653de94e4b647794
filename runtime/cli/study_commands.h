#pragma once

#include <string>

#include "runtime/command_line/command_line.h"

namespace gazeloop::cli {

/// Commands within `study`, each in a file of its own.
void add_study_analyse(Command study);
void add_study_power(Command study);
void add_study_published(Command study);
void add_study_simulate(Command study);
void add_study_run(Command study, const std::string& command_line);

}  // namespace gazeloop::cli
