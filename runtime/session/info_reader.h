#pragma once

#include "runtime/session/database.h"
#include "runtime/session/session_info.h"

namespace gazeloop::session {

/// Reads meta, config and device, and no other table. had_write_ahead_log stays unset.
/// Throws FormatError or DatabaseError.
SessionInfo read_info(const Database& database);

}  // namespace gazeloop::session
