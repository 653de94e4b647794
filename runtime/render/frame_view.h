#pragma once

#include <cstdint>

#include "runtime/foveation/picture/hidden_area.h"
#include "runtime/gaze/view.h"
#include "runtime/render/eye_target.h"

namespace gazeloop::render {

/// The part of a frame that needs no gaze: when, from where and into what it is rendered.
struct FrameView {
    std::uint64_t index = 0;
    double scene_time_s = 0.0;
    gaze::StereoView views;
    /// Any layout before; after, COLOR_ATTACHMENT_OPTIMAL and DEPTH_STENCIL_ATTACHMENT_OPTIMAL.
    gaze::PerEye<EyeTarget> targets;
    foveation::HiddenAreas hidden{};  ///< of these views; what they hide is black
};

}  // namespace gazeloop::render
