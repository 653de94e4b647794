#include "runtime/report/gaze_findings.h"

namespace gazeloop::report {

GazeFindings gaze_findings(const gaze::GazeTrace& trace) {
    gaze::GazeSmoothing smoothing;
    for (const gaze::GazeSample& sample : trace.samples) {
        smoothing.add(sample);
    }
    GazeFindings found{.quality = gaze::gaze_quality(trace.samples),
                       .smoothing = smoothing.finding(),
                       .events = gaze::recorded_events(trace.samples),
                       .statistics = {}};
    found.statistics = gaze::event_statistics(found.events);
    return found;
}

}  // namespace gazeloop::report
