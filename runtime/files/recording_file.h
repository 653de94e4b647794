#pragma once

#include <filesystem>

namespace gazeloop::files {

/// Whether a file begins as recordings do, which are SQLite files. False too for what is no regular
/// file and for what cannot be read.
[[nodiscard]] bool begins_as_recording(const std::filesystem::path& file);

/// The same, or it is one of the files that SQLite keeps beside a recording.
[[nodiscard]] bool belongs_to_recording(const std::filesystem::path& file);

}  // namespace gazeloop::files
