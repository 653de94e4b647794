#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "runtime/gaze/gaze_comparison.h"
#include "runtime/gaze/gaze_trace.h"
#include "runtime/report/gaze_findings.h"

namespace gazeloop::report::page {

/// A recording and what was found in it.
struct PageRecording {
    gaze::RecordingView trace;
    const GazeFindings& found;
    std::string refused;  ///< why run and replay refuse it; empty: they do not
};

/// Recorded gaze, one recording or two that are compared, as one HTML file that needs nothing else,
/// below 3 MB for each recording whatever its length. Its numbers are those of gaze_json().
[[nodiscard]] std::string gaze_page(std::span<const PageRecording> recordings,
                                    const gaze::GazeComparison* comparison);

}  // namespace gazeloop::report::page
