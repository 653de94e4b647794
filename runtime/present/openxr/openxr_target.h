#pragma once

#include <memory>

#include "runtime/present/display_profile.h"
#include "runtime/present/frame_target.h"

namespace gazeloop::present {

struct OpenXrOptions {
    DisplayProfile display;   ///< what the simulated display is set to, where we simulate it
    double scale = 1.0;       ///< of the runtime's recommended size
    bool validation = false;  ///< the core validation layer; its findings go to the log
    /// Give depth images along, where the runtime takes them (XR_KHR_composition_layer_depth).
    bool depth = false;
};

/// A stereo session: vulkan_enable2, one swapchain an eye, a projection layer in LOCAL space.
/// Throws SetupError (NoDevice) with the remedy when there is no runtime, or it lacks what we need.
std::unique_ptr<FrameTarget> make_openxr_target(const OpenXrOptions& options);

}  // namespace gazeloop::present
