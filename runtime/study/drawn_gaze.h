#pragma once

#include "runtime/gaze/fovea_point.h"
#include "runtime/gaze/view.h"

namespace gazeloop::study {

/// Foveae straight ahead of the head, whose forward is taken to lie midway between those of the
/// views. The rest is as the gaze had it.
[[nodiscard]] gaze::FrameFovea straight_ahead(const gaze::FrameFovea& latched,
                                              const gaze::StereoView& views);

/// How far the gaze is from there, in degrees: of the eye that is nearer.
[[nodiscard]] double off_ahead_deg(const gaze::FrameFovea& latched, const gaze::StereoView& views);

}  // namespace gazeloop::study
