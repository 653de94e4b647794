#pragma once

#include <filesystem>
#include <string_view>

#include "runtime/error.h"

namespace gazeloop::cli {

/// Writes a whole file; "-" is stdout. Errors (BadInput): it names the file and the reason.
Expected<void> write_text(const std::filesystem::path& file, std::string_view text);

}  // namespace gazeloop::cli
