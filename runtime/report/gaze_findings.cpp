#include "runtime/report/gaze_findings.h"

namespace gazeloop::report {

GazeFindings gaze_findings(const gaze::RecordingView& trace) {
    gaze::GazeSmoothing smoothing;
    gaze::RecordedEvents events;
    for (const gaze::GazeSample& sample : trace.samples) {
        smoothing.add(sample);
        events.add(sample);
    }
    GazeFindings found{.quality = gaze::gaze_quality(trace.samples, trace.rate_hz()),
                       .smoothing = smoothing.finding(),
                       .events = events.finish(),
                       .statistics = {}};
    found.statistics = gaze::event_statistics(found.events);
    return found;
}

}  // namespace gazeloop::report
