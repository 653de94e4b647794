#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <string_view>

#include "runtime/gaze/fovea_point.h"
#include "runtime/gaze/view.h"
#include "runtime/time/stamp.h"

namespace gazeloop::frame {

/// The GPU passes that are timed apart, each in a submit of its own.
enum class Pass : std::size_t { Full, PassI, Resolve, Disc };
inline constexpr std::size_t kPassCount = 4;
inline constexpr std::array<std::string_view, kPassCount> kPassNames{"full", "pass_i", "resolve",
                                                                     "disc"};

/// What the sampling plans of both eyes asked for, and what they left out.
struct SampleCounts {
    std::uint64_t texels_planned = 0;     ///< LP-buffer texels, w x h, both eyes
    std::uint64_t texels_shaded = 0;      ///< of them, shaded in pass I
    std::uint64_t texels_off_screen = 0;  ///< left out: no pixel on screen reads them
    std::uint64_t texels_under_disc = 0;  ///< left out: the direct disc covers them
    std::uint64_t texels_hidden = 0;      ///< left out: only hidden pixels read them
    std::uint64_t pixels_direct = 0;      ///< pixels shaded one by one (disc, or full resolution)
    std::uint64_t pixels_output = 0;      ///< pixels of the pictures
    std::uint64_t pixels_hidden = 0;      ///< of them not drawn: the headset shows them to no eye

    friend bool operator==(const SampleCounts&, const SampleCounts&) = default;
};

/// The points of one frame, as the loop passed them. Host time; in virtual time they are modelled.
struct FrameStamps {
    time::Stamp wake_up;    ///< the runtime let the loop go on
    time::Stamp begin;      ///< the frame was begun
    time::Stamp latch;      ///< the gaze was read for the last time
    time::Stamp submit;     ///< the last pass was handed to the GPU
    time::Stamp end_frame;  ///< the frame was handed to the compositor
    time::Stamp gpu_begin;  ///< the first pass began on the GPU, in host time
    time::Stamp gpu_end;    ///< the last pass ended on the GPU, in host time
    time::Stamp display;    ///< announced middle of the display's emission
};

/// Everything that is known of a frame when it is handed to the compositor. The GPU's part is added
/// later.
struct FrameRecord {
    std::uint64_t index = 0;
    FrameStamps stamps;
    std::int64_t period_ns = 0;  ///< the display's, as announced for this frame
    bool should_render = true;
    double scene_time_s = 0.0;
    gaze::Pose head;         ///< of the views, in world
    gaze::StereoView views;  ///< what was rendered
    gaze::FrameFovea fovea;  ///< meaningful if should_render
    SampleCounts samples;
};

/// What becomes known of a frame once the GPU has finished it.
struct FrameGpuRecord {
    std::uint64_t index = 0;
    time::Stamp gpu_begin;
    time::Stamp gpu_end;
    std::array<std::int64_t, kPassCount> pass_ns{-1, -1, -1, -1};  ///< -1: the pass did not run
    std::optional<std::uint64_t> pixel_hash;                       ///< of both eyes' pictures
};

}  // namespace gazeloop::frame
