#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/report/gaze_findings.h"

namespace gazeloop::report {

/// Rows on how far recorded gaze can be trusted: its intervals, losses, precision per eye and
/// whether somebody smoothed it (gaze/gaze_quality.h, gaze/smoothing.h).
[[nodiscard]] std::string quality_text(const GazeFindings& found);

/// The same as members "intervals", "losses", "precision" and "smoothing"; null for what is
/// unknown.
void add_quality(const GazeFindings& found, nlohmann::ordered_json& json);

}  // namespace gazeloop::report
