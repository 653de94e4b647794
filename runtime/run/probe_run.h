#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "runtime/run/frame_run.h"

namespace gazeloop::run {

/// What a run with the patch is to do.
struct ProbeRun {
    static constexpr std::int64_t kTrials = 20;

    std::optional<std::int64_t> trials;  ///< flashes of the lamp, after which it ends; or kTrials
    std::string json;                    ///< "-": stdout; empty: not asked for
    bool quiet = false;
};

/// Runs the loop with the patch that follows the tracker's losses, and says when it flipped.
/// `request` is the run, `settings` its own. Gives what frame_run() gives. @throws SetupError as
/// frame_run(), and for a file that cannot be written
std::optional<ErrorKind> probe_run(const ProbeRun& wanted, FrameRunRequest request,
                                   ProgramSettings& settings);

}  // namespace gazeloop::run
