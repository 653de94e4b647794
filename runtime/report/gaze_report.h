#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/gaze/gaze_trace.h"
#include "runtime/report/gaze_findings.h"

namespace gazeloop::report {

/// What there is to say of recorded gaze, a trace's or a session's, before it is played: for
/// people, at most 100 columns wide but for the file's name.
[[nodiscard]] std::string gaze_text(const gaze::RecordingView& trace);
/// The same where it was looked at already.
[[nodiscard]] std::string gaze_text(const gaze::RecordingView& trace, const GazeFindings& findings);

/// The same for programs, units in the keys, null for what is unknown.
[[nodiscard]] nlohmann::ordered_json gaze_json(const gaze::RecordingView& trace);
[[nodiscard]] nlohmann::ordered_json gaze_json(const gaze::RecordingView& trace,
                                               const GazeFindings& findings);

}  // namespace gazeloop::report
