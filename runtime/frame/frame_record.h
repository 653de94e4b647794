#pragma once

#include <cstdint>
#include <optional>

#include "runtime/frame/passes.h"
#include "runtime/frame/sample_counts.h"
#include "runtime/gaze/fovea_point.h"
#include "runtime/gaze/view.h"
#include "runtime/time/stamp.h"

namespace gazeloop::frame {

/// The points of one frame, as the loop passed them. Host time; in virtual time they are modelled.
struct FrameStamps {
    time::Stamp wake_up;    ///< the runtime let the loop go on
    time::Stamp begin;      ///< the frame was begun
    time::Stamp latch;      ///< the gaze was read for the last time
    time::Stamp filtered;   ///< the foveae were computed from it
    time::Stamp submit;     ///< the last pass was handed to the GPU
    time::Stamp end_frame;  ///< the frame was handed to the compositor
    time::Stamp gpu_begin;  ///< the first pass began on the GPU, in host time
    time::Stamp gpu_end;    ///< the last pass ended on the GPU, in host time
    time::Stamp present;    ///< the compositor handed it to the display, where the runtime tells
    time::Stamp display;    ///< announced middle of the display's emission
    /// The same as it came about, by the runtime's own account of the present. No session keeps it:
    /// unknown unless a report was given such an account.
    time::Stamp shown;
};

/// Everything that is known of a frame when it is handed to the compositor. The GPU's part is added
/// later.
struct FrameRecord {
    std::uint64_t index = 0;
    FrameStamps stamps;
    std::int64_t period_ns = 0;  ///< the display's, as announced for this frame
    bool should_render = true;
    std::optional<std::uint8_t> quality_level{};  ///< 0 the best; none: nobody governs it
    double scene_time_s = 0.0;
    gaze::Pose head;         ///< of the views, in world
    gaze::StereoView views;  ///< what was rendered
    gaze::FrameFovea fovea;  ///< meaningful if should_render
    SampleCounts samples;
    std::optional<std::int64_t> budget_ns{};  ///< of the latency budget's total; none: no limit
};

/// What becomes known of a frame once the GPU has finished it.
struct FrameGpuRecord {
    std::uint64_t index = 0;
    time::Stamp gpu_begin;
    time::Stamp gpu_end;
    PassTimes passes;       ///< by their places in the run's PassList
    PassTimes pass_starts;  ///< from gpu_begin to the begin of each pass's first part
    /// How far off host times of the GPU may be, either way, as its driver states. Unknown where
    /// its clock is not related to the host's.
    std::optional<std::int64_t> clock_deviation_ns;
    std::optional<std::uint64_t> pixel_hash;  ///< of both eyes' pictures
};

}  // namespace gazeloop::frame
