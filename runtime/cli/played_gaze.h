#pragma once

#include <functional>
#include <string>

#include "drivers/trace/read_options.h"
#include "runtime/cli/run_options.h"
#include "runtime/gaze/gaze_trace.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::cli {

/// The options of commands that play gaze, again and again, to whoever listens.
struct PlayedGaze {
    LogOptions log;
    std::string trace;
    std::string axes = "none";
    drivers::ReadOptions read;
    double seconds = 1e9;
    sim::GazeSimulation gaze;

    void add_to(Command command);

    /// The trace that is named, else simulated gaze of one lap. Throws SetupError.
    [[nodiscard]] gaze::GazeTrace samples() const;

    /// Calls `wait` with the host time at which a sample is due, then, unless the time is over or
    /// the user has interrupted, `send` with the sample and when it was taken (host time). From
    /// `begin_ns` on.
    void play(
        const gaze::GazeTrace& gaze, std::int64_t begin_ns,
        const std::function<void(std::int64_t due_ns)>& wait,
        const std::function<void(const gaze::GazeSample&, std::int64_t taken_ns)>& send) const;
};

}  // namespace gazeloop::cli
