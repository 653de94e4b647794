#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/latency/latency_summary.h"

namespace gazeloop::run {

/// What a run knows of its gaze at its end.
struct GazeAtEnd {
    std::string_view source;   ///< as --gaze has it
    bool from_device = false;  ///< a tracker or a sender gives it
    bool by_runtime = false;   ///< an OpenXR runtime gives it
    bool live = false;         ///< in real time, and not fixed in the head
    std::string_view fault;    ///< why a tracker that is there cannot be used; empty: nothing
    const latency::SummaryReport& report;
};

/// Why no sample came, with the remedy, where that is a device's failure; none otherwise.
[[nodiscard]] std::optional<std::string> why_no_gaze(const GazeAtEnd& gaze);

/// That no sample was of use in all the frames of a live run, with the remedy; empty otherwise.
[[nodiscard]] std::string no_gaze_warning(const GazeAtEnd& gaze);

/// What helps where a live source, as --gaze has it, gave no sample in a whole run.
[[nodiscard]] std::string no_gaze_remedy(std::string_view gaze);

}  // namespace gazeloop::run
