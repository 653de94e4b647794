#pragma once

#include <filesystem>
#include <span>
#include <string_view>
#include <vector>

#include "runtime/error.h"
#include "runtime/files/output_file.h"

namespace gazeloop::settings {
class Settings;
}

namespace gazeloop::report {

using files::check_output;
using files::OutputFile;
using files::write_text;

/// A file with the option or the word that names it. Empty: none; "-": stdin or stdout.
struct NamedFile {
    std::string_view name;
    std::filesystem::path file;
};

/// The files that settings were read from and name; the names live as long as the settings.
[[nodiscard]] std::vector<NamedFile> files_of(const settings::Settings& settings);

/// Checks that each output has a file of its own, and none of what is read, nor one that is there
/// in a folder that is read. Links are followed. Errors (Usage): both names and the file.
Expected<void> check_apart(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs);

/// The same, and that write_text() should then succeed with each: what every command asks before it
/// does anything. Errors: as check_apart() and files::check_output().
Expected<void> check_outputs(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs);

}  // namespace gazeloop::report
