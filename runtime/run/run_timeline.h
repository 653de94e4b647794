#pragma once

#include <memory>

#include "runtime/display/display_profile.h"
#include "runtime/frame_timeline.h"
#include "runtime/run/frame_run.h"

namespace gazeloop::run {

/// The profile's eyes at the target's picture sizes, head at the origin.
[[nodiscard]] gaze::StereoView profile_views(const display::DisplayProfile& profile,
                                             const gaze::PerEye<vk::Extent2D>& extents);

/// Whose time the run's loop follows, by the request's clock.
[[nodiscard]] std::unique_ptr<FrameTimeline> run_timeline(
    const FrameRunRequest& request, const display::DisplayProfile& profile,
    const gaze::PerEye<vk::Extent2D>& extents);

}  // namespace gazeloop::run
