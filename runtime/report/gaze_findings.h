#pragma once

#include <vector>

#include "runtime/gaze/events/event_statistics.h"
#include "runtime/gaze/gaze_quality.h"
#include "runtime/gaze/gaze_trace.h"
#include "runtime/gaze/smoothing.h"

namespace gazeloop::report {

/// What there is to find in recorded gaze, computed once for text, JSON and page.
struct GazeFindings {
    gaze::GazeQuality quality;
    gaze::SmoothingFinding smoothing;
    std::vector<gaze::RecordedEvent> events;
    gaze::EventStatistics statistics;
};

[[nodiscard]] GazeFindings gaze_findings(const gaze::GazeTrace& trace);

}  // namespace gazeloop::report
