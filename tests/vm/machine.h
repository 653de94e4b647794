#pragma once

#include <map>
#include <string>

namespace gazeloop::tests {

/// What is missing on this machine for a virtual one, with the remedy; empty where nothing is.
[[nodiscard]] std::string missing_for_machine();

/// Builds the virtual machine's file system, boots Debian's kernel with it in QEMU's software
/// emulation, and waits until it has switched itself off. Empty, or what went wrong; files of what
/// it said stay in machine_folder().
[[nodiscard]] std::string run_machine();

/// A part of what the virtual machine printed.
struct Section {
    std::string text;
    int exit_code = -1;
};

/// By name. Throws std::runtime_error where the machine has not run to its end.
[[nodiscard]] std::map<std::string, Section> machine_sections();

/// Why the machine did not run; empty where it did.
[[nodiscard]] std::string machine_skipped();
void skip_machine(const std::string& reason);

}  // namespace gazeloop::tests
