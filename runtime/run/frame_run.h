#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

#include "drivers/gaze_source.h"
#include "drivers/openxr/openxr_source.h"
#include "runtime/error.h"
#include "runtime/frame_loop.h"
#include "runtime/present/button_source.h"
#include "runtime/report/output_file.h"
#include "runtime/run/program_settings.h"
#include "runtime/session/open_session.h"
#include "runtime/session/session_recorder.h"

namespace gazeloop::run {

/// Which time line a run follows.
enum class RunClock {
    Wall,
    Virtual,
    Recorded,  ///< the recorded session's own
};

/// A recorded session that is run again. It has been checked: no frame is missing.
struct Recording {
    const session::OpenSession* session = nullptr;  ///< never null
    std::uint64_t frames = 0;                       ///< 1 or more, numbered from 0
    gaze::StereoView views{};  ///< of the first frame; all frames have its pictures' sizes
};

/// A run of the loop, ready to start: everything that can be checked without a device has been.
struct FrameRunRequest {
    const ProgramSettings* settings = nullptr;
    std::string command_line;
    RunClock clock = RunClock::Wall;
    std::function<std::unique_ptr<drivers::GazeSource>(std::int64_t start_ns)> make_source;
    /// The gaze of the target's own OpenXR session, in place of make_source.
    std::optional<drivers::OpenXrGazeOptions> openxr_gaze;
    bool from_device = false;              ///< the gaze, by either of the two
    std::string gaze{};                    ///< the source, as --gaze has it; empty: no such option
    bool reads_trace = false;              ///< the gaze, by the settings trace.*
    bool many_pictures = false;            ///< each with settings of its own: a study's
    bool live_gaze = false;                ///< from a device, or simulated: held against anatomy
    std::optional<Recording> recording{};  ///< set for Recorded only; the run is compared with it
    std::string other_foveae{};  ///< why foveae need not be the recording's; empty: they must
    bool same_rendering = true;  ///< settings that decide pixels are the recording's
    /// Makes an observer that draws into the finished pictures, before whoever reads them; none if
    /// unset. It must not outlive the context.
    std::function<std::unique_ptr<frame::FrameObserver>(const vulkan::Context&,
                                                        const render::RendererConfig&)>
        make_overlay{};
    /// Decides by whom each frame is drawn; null: by render.method. Must outlive the run.
    render::FrameChooser* chooser = nullptr;
    /// With the scene, the camera and what else of the settings decides pictures as these are now.
    using MakeRenderer =
        std::function<std::unique_ptr<render::FrameRenderer>(const render::MakePasses&)>;
    /// What a frame takes by a renderer, ms; none where that is not the wall clock's, or unknown.
    using TimeRenderer = std::function<std::optional<double>(render::FrameRenderer&)>;
    /// Called before the first frame, with what makes and times the chooser's renderers.
    std::function<void(const MakeRenderer&, const TimeRenderer&)> prepare_chooser{};
    /// Called before the first frame with where somebody's presses come from: the preview's window
    /// and game controllers, the controllers of an OpenXR runtime. Unset: nobody's are taken.
    std::function<void(std::vector<present::ButtonSource*>)> take_presses{};
    /// Called with the recording, which then has a study's tables.
    std::function<void(session::SessionRecorder&)> record_study{};
    frame::FrameObserver* observer = nullptr;  ///< is told what the loop does, unless null
    LoopOptions loop;                          ///< its `stop` is asked beside what else ends a run
    bool hash = false;
    bool mark_fovea = false;
    bool quiet = false;
    bool monitor = false;               ///< a live panel on stderr
    std::optional<int> monitor_json{};  ///< a file descriptor that LineWriter does not refuse
    std::uint32_t preview_eyes = 0;     ///< preview::kLeftEye and the like; 0: no preview
    std::optional<std::filesystem::path> record;
    std::optional<std::filesystem::path> snapshot;
    std::optional<std::filesystem::path> json;
    /// What the run reads: none of it is written over.
    std::vector<report::NamedFile> reads{};
};

/// Sets up target, device and renderer, runs the loop, and prints the summary to stdout. Throws
/// SetupError for what goes wrong before the first frame. What goes wrong later is reported after
/// the summary, and the first such error is returned (none: all went well).
std::optional<ErrorKind> frame_run(const FrameRunRequest& request);

}  // namespace gazeloop::run
