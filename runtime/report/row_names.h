#pragma once

#include <algorithm>
#include <cstddef>
#include <string>
#include <string_view>

#include "runtime/latency/gaze_age.h"

namespace gazeloop::report {

/// What one quantity of a report is called.
struct RowName {
    std::string key;    ///< for programs, e.g. "stage_wait_for_display"
    std::string label;  ///< for people; stages are indented below their sum
};

inline const RowName kGazeAgeAtLatch{"gaze_age_at_latch", "gaze age at latch"};
inline const RowName kGazeAgeReadAtBegin{"gaze_age_read_at_begin", "  read at frame begin"};
inline const RowName kGazeAgeAtDisplay{"gaze_age_at_display", "gaze age at display"};
inline const RowName kGazeAgeUncertainty{"gaze_age_uncertainty", "  uncertain by"};
inline const RowName kUnaccounted{"unaccounted", "  unaccounted"};
inline const RowName kHeldGazeAge{"held_gaze_age_at_display", "held gaze at display"};
inline const RowName kFrameInterval{"frame_interval", "frame interval"};
inline const RowName kLoopTime{"loop_time", "loop (cpu)"};
inline const RowName kGazeError{"gaze_error_at_display", "gaze error at display"};
inline const RowName kGazeErrorWithoutPoses{"gaze_error_without_poses", "  without head poses"};
inline const RowName kPeriodsMissed{"periods_missed", "periods missed"};
inline const RowName kSamplesShaded{"samples_shaded", "samples shaded"};

/// Precondition: stage < latency::kStageCount.
[[nodiscard]] inline RowName stage_name(std::size_t stage) {
    const std::string name(latency::kStageNames[stage]);
    std::string key = "stage_" + name;
    std::ranges::replace(key, ' ', '_');
    return {key, "  " + name};
}

[[nodiscard]] inline RowName pass_name(std::string_view pass) {
    return {"pass_" + std::string(pass), "pass " + std::string(pass)};
}

}  // namespace gazeloop::report
