#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/gaze/gaze_comparison.h"

namespace gazeloop::report {

/// How much later the second one is, and how sure that is; one sentence without a full stop.
[[nodiscard]] std::string lag_text(const gaze::GazeComparison& comparison);
/// What to make of a doubtful one.
[[nodiscard]] std::string doubt_text();

/// What two recordings of the same eyes have in common, for people, at most 100 columns wide.
[[nodiscard]] std::string gaze_comparison_text(const gaze::GazeComparison& comparison);

/// The same for programs, units in the keys; null: the interval is unknown.
[[nodiscard]] nlohmann::ordered_json gaze_comparison_json(const gaze::GazeComparison& comparison);

}  // namespace gazeloop::report
