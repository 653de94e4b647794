#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/session/session_header.h"

namespace gazeloop::session {

/// Everything that a session says beside its frames, samples and events.
struct SessionInfo {
    SessionHeader header;  ///< as given to the recorder, as far as its version keeps it
    int schema_version = 0;
    std::uint64_t records_dropped = 0;  ///< by a full queue, as known when writing ended
    bool closed_cleanly = false;
    bool writing_failed = false;       ///< and this could still be noted on disk
    bool had_write_ahead_log = false;  ///< a log with content lay beside the file
    std::string missing_log{};  ///< of a recording that was not closed: see write_ahead_log.h

    /// The value of a setting in that run; nothing if the session does not have it.
    [[nodiscard]] std::optional<std::string_view> config(std::string_view key) const;
};

}  // namespace gazeloop::session
