#pragma once

#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/session/session_header.h"

namespace gazeloop::session {

/// Everything that a session says beside its frames, samples and events.
struct SessionInfo {
    SessionHeader header;  ///< as it was given to the recorder, as far as its version keeps it
    int schema_version = 0;
    std::uint64_t records_dropped = 0;  ///< by a full queue, as far as was known when writing ended
    bool closed_cleanly = false;
    bool writing_failed = false;       ///< and the disk still took a note of it
    bool had_write_ahead_log = false;  ///< a log with content lay beside it

    /// The setting that was in force.
    [[nodiscard]] std::optional<std::string_view> config(std::string_view key) const;
};

}  // namespace gazeloop::session
