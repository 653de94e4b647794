#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/gaze/gaze_comparison.h"

namespace gazeloop::report {

/// What two recordings of the same eyes have in common, for people, at most 100 columns wide.
[[nodiscard]] std::string gaze_comparison_text(const gaze::GazeComparison& comparison);

/// The same for programs, units in the keys; null: the interval is unknown.
[[nodiscard]] nlohmann::ordered_json gaze_comparison_json(const gaze::GazeComparison& comparison);

}  // namespace gazeloop::report
