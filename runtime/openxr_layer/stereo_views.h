#pragma once

#include <optional>

#include "runtime/gaze/view.h"
#include "runtime/openxr_layer/next_functions.h"

namespace gazeloop::openxr_layer {

/// Pose and field of view of both eyes, without sizes; none where the runtime gave what is no view.
[[nodiscard]] std::optional<gaze::StereoView> stereo_of(const XrView* views);

/// Where the runtime says that the eyes' views are in a space; none where it does not know.
[[nodiscard]] std::optional<gaze::StereoView> stereo_views(const NextFunctions& next,
                                                           XrSession session, XrSpace space,
                                                           XrTime time);

}  // namespace gazeloop::openxr_layer
