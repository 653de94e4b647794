#pragma once

#include <memory>
#include <span>

#include "runtime/display/display_profile.h"
#include "runtime/error.h"
#include "runtime/latency/latency_summary.h"
#include "runtime/report/frame_log.h"
#include "runtime/report/lag_facts.h"
#include "runtime/report/runtime_metrics/runtime_account.h"
#include "runtime/report/trace_account.h"
#include "runtime/session/playback.h"

namespace gazeloop::report {

latency::SummaryConfig summary_config(const display::DisplayProfile& display,
                                      latency::LoopClock clock);

/// What a recorded session shows once it has been played.
struct SessionSummary {
    latency::SummaryReport report;  ///< as at the end of its run, but with exact percentiles
    std::unique_ptr<const FrameLog> frames;
    TraceAccount trace;
    RuntimeAccount runtime{};
    GazeOrigin origin = GazeOrigin::Unknown;
    latency::GazeUseCounts use{};
    gaze::SmoothingFinding smoothing{};
    FixedText<240> unplaced{};  ///< what its gaze needed to have a direction; empty: nothing
    session::PlaybackEnd end;
};

/// Who is told a session beside its summary.
struct AlsoTold {
    std::span<frame::FrameObserver* const> observers{};
    session::PlayedGaze gaze = session::PlayedGaze::Counts;  ///< whether they need every sample
};

/// `files` are of the session's run. Errors: see session::play() and RuntimeAccount::open().
Expected<SessionSummary> summarize(const session::OpenSession& session,
                                   const RuntimeFiles& files = {}, const AlsoTold& also = {});

}  // namespace gazeloop::report
