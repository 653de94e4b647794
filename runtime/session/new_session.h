#pragma once

#include <filesystem>
#include <optional>

#include "runtime/error.h"
#include "runtime/session/session_recorder.h"

namespace gazeloop::session {

/// Creates a session file with mode 0600, with schema and header, in WAL mode and open nowhere. It
/// is made under a temporary name beside it (FILE.partial-XXXXXX) and then renamed, so `file` is a
/// complete session as soon as it exists. After an error nothing is left. Errors: see
/// SessionRecorder::create.
std::optional<Error> create_session(const std::filesystem::path& file, const SessionHeader& header);

/// What create_session() would refuse at once, without creating anything.
std::optional<Error> refuse_session(const std::filesystem::path& file);

/// Removes a session that is open nowhere, and what SQLite may have left beside it.
void remove_session(const std::filesystem::path& file);

}  // namespace gazeloop::session
