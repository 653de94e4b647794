#pragma once

#include <filesystem>
#include <string_view>

#include "runtime/error.h"

namespace gazeloop::report {

/// Whether write_text() can be expected to succeed, so that a long run is not started for nothing.
/// Creates and changes nothing. Errors (BadInput): it names the file and the reason.
Expected<void> check_output(const std::filesystem::path& file);

/// Writes a whole file; "-" is stdout. A file that was there is replaced at the end, by one
/// complete new one; where that cannot be (a device, a folder that is closed) it is written in
/// place. Errors (BadInput): it names the file and the reason; what was there before then still is.
Expected<void> write_text(const std::filesystem::path& file, std::string_view text);

}  // namespace gazeloop::report
