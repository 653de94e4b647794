#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string>
#include <vector>

#include "tests/support/watch/watched_call.h"

namespace gazeloop::tests {

/// What the loop's own code did in one frame, from the end of the one before to its end, outside
/// calls of Vulkan and OpenXR.
struct WatchedFrame {
    std::int64_t cpu_ns = 0;  ///< with cpu_ns_of_watching_a_call() for every call
    SinceGaze gaze{};         ///< -1 in both: nothing was drawn
    std::size_t allocations = 0;
    std::uint64_t calls = 0;
    std::size_t resident_bytes = 0;  ///< of the process; only where asked for
};

struct WatchedLoop {
    bool openxr = false;       ///< else headless
    bool openxr_gaze = false;  ///< with openxr: its eye gaze, else simulated gaze with blinks
    bool from_depth = true;    ///< with openxr_gaze: split where the last frame's depth says
    bool paced = true;         ///< headless: at the display's rate
    bool hash = false;
    double scale = 0.05;  ///< of the display's size
    std::size_t frames = 200;
    std::size_t resident_every = 0;  ///< frames between readings of resident_bytes; 0: none
    std::string method = "kfr";
    std::filesystem::path record{};  ///< empty: no recording
    int monitor_fd =
        -1;  ///< with a budget that is broken, and its monitor's lines to there; -1: none
};

/// Runs the frame loop as `gazeloop run` puts it together, and watches its thread. Throws
/// SetupError.
std::vector<WatchedFrame> run_watched_loop(const WatchedLoop& options);

}  // namespace gazeloop::tests
