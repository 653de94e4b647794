#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "drivers/gaze_source.h"
#include "drivers/openxr/openxr_source.h"
#include "runtime/error.h"
#include "runtime/frame_loop.h"
#include "runtime/run/program_settings.h"
#include "runtime/session/open_session.h"

namespace gazeloop::run {

/// Which time line a run follows.
enum class RunClock {
    Wall,
    Virtual,
    Recorded,  ///< a session's own
};

/// A recorded session that is run again, found whole from its first frame to its last.
struct Recording {
    const session::OpenSession* session = nullptr;  ///< never null
    std::uint64_t frames = 0;                       ///< 1 or more, numbered from 0
    gaze::StereoView views{};                       ///< of the first; all have its pictures' sizes
};

/// A run of the loop, ready to go; everything that can be refused without a device has been.
struct FrameRunRequest {
    const ProgramSettings* settings = nullptr;
    std::string command_line;
    RunClock clock = RunClock::Wall;
    std::function<std::unique_ptr<drivers::GazeSource>(std::int64_t start_ns)> make_source;
    /// The gaze of the target's own OpenXR session, in place of make_source.
    std::optional<drivers::OpenXrGazeOptions> openxr_gaze;
    bool from_device = false;              ///< the gaze, of either
    std::optional<Recording> recording{};  ///< with Recorded alone, and to be compared with
    bool same_gaze = true;                 ///< settings as the recording's
    bool same_rendering = true;            ///< settings as the recording's
    LoopOptions loop;
    bool hash = false;
    bool mark_fovea = false;
    bool quiet = false;
    std::uint32_t preview_eyes = 0;  ///< preview::kLeftEye and the like; 0: no preview
    std::optional<std::filesystem::path> record;
    std::optional<std::filesystem::path> snapshot;
    std::optional<std::filesystem::path> json;
};

/// Sets up target, device and renderer, runs the loop, prints the summary to stdout. What went
/// wrong after the first frame is reported after the summary; the first of it is returned (none:
/// all went well). Throws SetupError for what goes wrong before.
std::optional<ErrorKind> frame_run(const FrameRunRequest& request);

}  // namespace gazeloop::run
