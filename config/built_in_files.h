#pragma once

#include <span>
#include <string_view>

namespace gazeloop::config {

/// A file of config/, built into the program so that it needs no installation.
struct BuiltInFile {
    std::string_view folder;  ///< budgets, displays, governor, trackers
    std::string_view name;    ///< without .toml
    std::string_view text;
};

std::span<const BuiltInFile> built_in_files();

}  // namespace gazeloop::config
