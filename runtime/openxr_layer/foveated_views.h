#pragma once

#include <optional>

#include "runtime/openxr_layer/layered_instance.h"

namespace gazeloop::openxr_layer {

/// A session's views of the next frame, in the head, and where in them it is looked.
struct FoveatedViews {
    gaze::StereoView views_in_head;
    gaze::FrameFovea fovea;

    /// Whether the foveae rest on gaze: fresh, of the other eye, or held.
    [[nodiscard]] bool follows_gaze() const;
};

/// As of now, for pictures that are shown at `display`, 4096 pixels each way: only shares of their
/// sides matter. None where there is no gaze source, the application may not have foveation, or the
/// runtime knows no views. Under the instance's mutex.
[[nodiscard]] std::optional<FoveatedViews> foveated_views(LayeredInstance& layered,
                                                          LayeredSession& session, XrTime display);

}  // namespace gazeloop::openxr_layer
