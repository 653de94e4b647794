#pragma once

#include <optional>
#include <string>

#include "runtime/run/frame_run.h"

namespace gazeloop::run {

/// What is to be played again, and how.
struct Replay {
    std::string file;             ///< a trace, or a session
    std::string format = "auto";  ///< of a trace
    bool wall_clock = false;      ///< in real time, else the same result on every run
    double speed = 1.0;           ///< how many times as fast as recorded
};

/// A session that is to be run again. What it was run with becomes the settings' values, and what
/// it lacks is logged. @throws SetupError (BadInput) for what is no session, or not of this program
[[nodiscard]] session::OpenSession open_for_replay(const std::string& file,
                                                   ProgramSettings& settings);

/// Run again with `settings`, which a recorded study varies; `request` holds what else is asked
/// for, and refers to `settings`. In real time only the session's gaze is played. @throws
/// SetupError as frame_run(); BadInput for a damaged recording; Usage for a speed that a session's
/// own time line cannot have
std::optional<ErrorKind> replay_session(const Replay& replay, const session::OpenSession& session,
                                        ProgramSettings& settings, FrameRunRequest& request);

/// The same of a trace. @throws SetupError as frame_run(); BadInput for a trace that is refused
std::optional<ErrorKind> replay_trace(const Replay& replay, ProgramSettings& settings,
                                      FrameRunRequest& request);

}  // namespace gazeloop::run
