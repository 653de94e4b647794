#pragma once

#include <memory>
#include <vector>

#include "runtime/display/display_profile.h"
#include "runtime/openxr/session.h"
#include "runtime/present/frame_target.h"

namespace gazeloop::present {

struct OpenXrOptions {
    display::DisplayProfile
        display;              ///< what the simulated display is set to, where we simulate it
    double scale = 1.0;       ///< of the runtime's recommended size
    bool validation = false;  ///< the core validation layer; its findings go to the log
    /// Give depth images along, where the runtime takes them (XR_KHR_composition_layer_depth).
    bool depth = false;
    /// How long the runtime may announce no display time that is one, s, before the session counts
    /// as lost.
    double patience_s = 2.0;
    /// Extensions for whatever shares the session, enabled where the runtime offers them.
    std::vector<const char*> extensions{};
};

/// A stereo session: vulkan_enable2, one swapchain per eye, a projection layer in LOCAL space.
class OpenXrTarget : public FrameTarget {
  public:
    [[nodiscard]] virtual const openxr::Instance& instance() const = 0;
    /// For a gaze source or answers that share it. Precondition: start() was called.
    [[nodiscard]] virtual openxr::Session& session() = 0;
};

/// Throws SetupError (NoDevice) with the remedy when there is no runtime, or it lacks what we need.
std::unique_ptr<OpenXrTarget> make_openxr_target(const OpenXrOptions& options);

}  // namespace gazeloop::present
