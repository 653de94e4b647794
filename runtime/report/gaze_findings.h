#pragma once

#include "runtime/gaze/events/event_statistics.h"
#include "runtime/gaze/gaze_quality.h"
#include "runtime/gaze/gaze_trace.h"
#include "runtime/gaze/smoothing.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::report {

/// What there is to find in recorded gaze, computed once for text, JSON and page.
struct GazeFindings {
    gaze::GazeQuality quality;
    gaze::SmoothingFinding smoothing;
    memory::LongVector<gaze::RecordedEvent> events;
    gaze::EventStatistics statistics;
};

[[nodiscard]] GazeFindings gaze_findings(const gaze::RecordingView& trace);

}  // namespace gazeloop::report
