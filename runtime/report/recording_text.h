#pragma once

#include <string>
#include <vector>

#include "runtime/session/playback.h"
#include "runtime/session/session_info.h"

namespace gazeloop::report {

/// What a recording lacks, and how its run failed: one sentence or more each. Empty for a complete
/// recording of a run that did not fail.
[[nodiscard]] std::vector<std::string> recording_lines(const session::SessionInfo& info,
                                                       const session::PlaybackEnd& end);

}  // namespace gazeloop::report
