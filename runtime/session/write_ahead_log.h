#pragma once

#include <filesystem>
#include <string>

namespace gazeloop::session {

/// Whether a log with content lies beside the file. An empty one may be SQLite's own, for reading.
bool has_write_ahead_log(const std::filesystem::path& file);

/// Where a file is in WAL mode, as a recorder leaves it that did not close it, and its log does not
/// lie beside it: which file is missing, what that means and what to do; else empty.
std::string missing_log(const std::filesystem::path& file);

}  // namespace gazeloop::session
