#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::report {

/// Rows on how far recorded gaze can be trusted: its intervals, losses, precision per eye and
/// whether somebody smoothed it (gaze/gaze_quality.h, gaze/smoothing.h).
[[nodiscard]] std::string quality_text(const gaze::GazeTrace& trace);

/// The same as members "intervals", "losses", "precision" and "smoothing"; null for what is
/// unknown.
void add_quality(const gaze::GazeTrace& trace, nlohmann::ordered_json& json);

}  // namespace gazeloop::report
