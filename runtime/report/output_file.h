#pragma once

#include <filesystem>
#include <string_view>

#include "runtime/error.h"

namespace gazeloop::report {

/// Checks whether write_text() should succeed, so that a long run is not started for nothing.
/// Creates and changes nothing. Errors (BadInput): file and reason are named.
Expected<void> check_output(const std::filesystem::path& file);

/// Writes a whole file; "-" is stdout. An existing file is replaced at the end, by a complete new
/// one. Where that is not possible (a device, a folder without write permission), it is written in
/// place. Errors (BadInput): file and reason are named; what was there before then still is.
Expected<void> write_text(const std::filesystem::path& file, std::string_view text);

}  // namespace gazeloop::report
