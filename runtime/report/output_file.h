#pragma once

#include <filesystem>
#include <span>
#include <string_view>

#include "runtime/error.h"
#include "runtime/files/output_file.h"

namespace gazeloop::report {

using files::check_output;
using files::OutputFile;
using files::write_text;

/// A file with the option or the word that names it. Empty: none; "-": stdin or stdout.
struct NamedFile {
    std::string_view name;
    std::filesystem::path file;
};

/// Checks that each output has a file of its own, and none of what is read. Links are followed.
/// Errors (Usage): both names and the file.
Expected<void> check_apart(std::span<const NamedFile> outputs, std::span<const NamedFile> inputs);

}  // namespace gazeloop::report
