#pragma once

#include <nlohmann/json.hpp>
#include <span>
#include <string>
#include <vector>

#include "runtime/gaze/gaze_comparison.h"
#include "runtime/gaze/gaze_trace.h"
#include "runtime/report/gaze_findings.h"
#include "runtime/report/gaze_page/gaze_bins.h"
#include "runtime/report/page/page_parts.h"

namespace gazeloop::report::page {

/// A figure, and what page/gaze_plots.js draws in it: its `id` and `kind`, which is
/// - "time": numbers of the stream `stream`: its `series` (key and name) in `unit`, or `events`,
/// - "points": `sets` of `points` with a `name` and a `form`, "points" or "line"; titles `x`, `y`,
/// - "bars": `counts` of `known` `what` in bins of `width` from `first` on; title `x`.
/// `empty`: there is nothing to draw.
struct DrawnFigure {
    Figure figure;
    nlohmann::ordered_json drawn;
};

/// Of a recording, in the order of the page. `number` of the recording, from 1, ends the ids.
struct RecordingFigures {
    std::vector<DrawnFigure> over_time;
    std::vector<DrawnFigure> quality;
    std::vector<DrawnFigure> events;
};
[[nodiscard]] RecordingFigures recording_figures(const gaze::RecordingView& trace,
                                                 const GazeFindings& found, const GazeBins& bins,
                                                 std::size_t number, std::size_t stream);

[[nodiscard]] std::vector<DrawnFigure> comparison_figures(const gaze::GazeComparison& comparison,
                                                          const GazeBins& bins, std::size_t stream);

}  // namespace gazeloop::report::page
