#pragma once

#include <cstdint>
#include <functional>
#include <string>

#include "drivers/trace/read_options.h"
#include "runtime/gaze/gaze_trace.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::simulate {

/// Whether the user has had enough; asked often.
using Interrupted = std::function<bool()>;

/// Gaze that is played, again and again, to whoever listens.
struct PlayedGaze {
    std::string trace;  ///< empty: simulated gaze
    drivers::ReadOptions read{};
    sim::GazeSimulation gaze{};
    double seconds = 1e9;  ///< it ends after these

    /// The trace that is named, else simulated gaze of one lap. @throws SetupError (BadInput) for
    /// a trace that is refused
    [[nodiscard]] gaze::GazeTrace samples() const;

    /// Calls `wait` with the host time at which a sample is due, then, unless the time is over or
    /// the user has interrupted, `send` with the sample and when it was taken (host time). From
    /// `begin_ns` on.
    void play(
        const gaze::GazeTrace& gaze, std::int64_t begin_ns, const Interrupted& interrupted,
        const std::function<void(std::int64_t due_ns)>& wait,
        const std::function<void(const gaze::GazeSample&, std::int64_t taken_ns)>& send) const;
};

}  // namespace gazeloop::simulate
