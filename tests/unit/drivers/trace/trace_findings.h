#pragma once

#include <string>
#include <vector>

#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::drivers {

inline std::vector<gaze::TraceFinding> findings(const gaze::GazeTrace& trace,
                                                gaze::TraceFindingKind kind) {
    std::vector<gaze::TraceFinding> found;
    for (const gaze::TraceFinding& finding : trace.report.findings()) {
        if (finding.kind == kind) {
            found.push_back(finding);
        }
    }
    return found;
}

/// The findings of a kind as lines of text, "LINE: TEXT".
inline std::vector<std::string> told(const gaze::GazeTrace& trace, gaze::TraceFindingKind kind) {
    std::vector<std::string> lines;
    for (const gaze::TraceFinding& finding : findings(trace, kind)) {
        lines.push_back(std::to_string(finding.line) + ": " + finding.text);
    }
    return lines;
}

}  // namespace gazeloop::drivers
