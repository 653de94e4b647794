#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <vector>

#include "runtime/report/frame_log.h"
#include "runtime/report/percentiles.h"
#include "runtime/report/session_rows.h"

namespace gazeloop::report {

/// How old the gaze was and how far off the fovea, by what the eyes did when the frame was shown:
/// errors during saccades are hardly seen, those of fixations are. A row for each event that some
/// frame with fresh gaze was shown in; its kind is the least certain one of all frames.
struct EyeEventRows {
    EyeEventSource source = EyeEventSource::None;
    std::vector<SessionRow> ages;    ///< of kGazeAgeAtDisplay
    std::vector<SessionRow> errors;  ///< of kGazeError
    std::uint64_t with_gaze = 0;     ///< frames whose foveae rest on a fresh sample
    std::uint64_t unknown = 0;       ///< of them, those of which nobody knows what the eyes did

    [[nodiscard]] bool any() const { return !ages.empty(); }
};

[[nodiscard]] EyeEventRows rows_by_eye_event(const FrameLog& frames,
                                             std::span<const double> percents);

/// By whom the events are known, and of how many frames not: a sentence for people.
[[nodiscard]] std::string source_text(const EyeEventRows& rows);

}  // namespace gazeloop::report
