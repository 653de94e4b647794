#pragma once

#include <string_view>

#include "runtime/gaze/gaze_trace.h"
#include "runtime/session/open_session.h"

namespace gazeloop::recordings {

/// The format of such a trace.
inline constexpr std::string_view kSessionFormat = "session";

/// A recorded session's gaze as a trace: see GazeTrace. No reader's report.
/// Throws SetupError (BadInput): damaged, or it holds no gaze.
[[nodiscard]] gaze::GazeRecording trace_of_session(const session::OpenSession& session);

}  // namespace gazeloop::recordings
