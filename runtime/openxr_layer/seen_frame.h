#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <variant>

#include "runtime/fixed_text.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/gaze/view.h"
#include "runtime/time/stamp.h"

namespace gazeloop::openxr_layer {

/// What a frame was handed over with.
struct FramePictures {
    gaze::PerEye<std::array<std::uint32_t, 2>> sizes_px{};  ///< 0: none
    bool of_views = true;  ///< false: of panels alone; the sizes are those of the display
};

/// A frame as it passed the API. Host times.
struct SeenFrame {
    std::int64_t wake_up_ns = 0;
    std::optional<std::int64_t> begin_ns;
    std::optional<std::int64_t> latch_ns;
    std::int64_t submit_ns = 0;
    std::int64_t end_frame_ns = 0;
    std::optional<std::int64_t> display_ns;
    std::int64_t period_ns = 0;
    std::uint64_t index = 0;
    std::optional<gaze::StereoView> views;  ///< none: nobody asked for them
    FramePictures pictures;
    bool should_render = true;
};

/// Where the head is at the newest of the samples that follow, in the space of the views.
struct SeenHead {
    std::int64_t time_ns = 0;
    std::optional<gaze::Pose> head;
};
/// A sample, at its time or that of its arrival.
struct ArrivedSample {
    gaze::GazeSample sample;
    std::int64_t time_ns = 0;
    std::uint64_t frame = 0;  ///< the next one that is handed over
    bool newest = false;
};
struct CompositedFrame {
    std::uint64_t index = 0;
    std::int64_t gpu_ns = 0;
};
struct SaidEvent {
    time::Stamp time;
    FixedText<32> kind;
    FixedText<240> text;
};

/// What a call of the application's leaves to be recorded.
using Seen = std::variant<SeenFrame, SeenHead, ArrivedSample, CompositedFrame, SaidEvent>;

}  // namespace gazeloop::openxr_layer
