#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <vector>

#include "drivers/gaze_source.h"
#include "runtime/frame/frame_observer.h"
#include "runtime/frame_timeline.h"
#include "runtime/gaze/gaze_to_fovea.h"
#include "runtime/present/frame_target.h"
#include "runtime/render/frame_chooser.h"
#include "runtime/render/frame_renderer.h"

namespace gazeloop {

/// Why a loop ended.
enum class LoopEnd {
    Limit,        ///< the requested number of frames or seconds
    SourceEnd,    ///< the trace or the recorded session is over
    Interrupted,  ///< by a signal
    Closed,       ///< its window was closed
    TargetEnd,    ///< the runtime asked for it
};

struct LoopOptions {
    std::optional<std::uint64_t> frames;
    std::optional<double> seconds;  ///< on the time line, from its start
    bool end_with_source = false;
    bool hidden_area = true;  ///< leave out what no eye sees
    /// Read the gaze only when the GPU has finished what of the frame needs no gaze, if anything is
    /// drawn before it. The gaze is then younger by that; the GPU idles for as long as it takes to
    /// plan and record the rest.
    bool wait_before_latch = true;
    std::optional<std::int64_t> budget_ns{};  ///< of the latency budget's total: for the records
    std::function<std::optional<LoopEnd>()>
        stop;  ///< called once per frame: the reason to end, if any
};

struct LoopResult {
    LoopEnd end = LoopEnd::Limit;
    std::uint64_t frames = 0;
    bool fixed_in_head = false;  ///< the gaze was fixed on purpose
};

/// The parts of a running loop. Time line and source are made at the first frame that the target
/// asks for, so that no recorded gaze is lost during set-up.
struct LoopParts {
    present::FrameTarget& target;
    render::FrameRenderer& renderer;
    gaze::GazeToFovea& gaze;
    std::function<std::unique_ptr<FrameTimeline>()> make_timeline;
    std::function<std::unique_ptr<drivers::GazeSource>(std::int64_t start_ns)> make_source;
    std::vector<frame::FrameObserver*> observers;
    render::FrameChooser* chooser = nullptr;  ///< null: `renderer` draws all frames
};

/// The gaze-contingent frame loop: wait, begin, locate, wait for the GPU, read the gaze as late as
/// possible, render for it, end. Throws SetupError (SessionLost) when the target is lost and
/// vk::SystemError when the device fails; the observers then have everything up to that frame.
LoopResult run_frame_loop(const LoopParts& parts, const LoopOptions& options);

}  // namespace gazeloop
