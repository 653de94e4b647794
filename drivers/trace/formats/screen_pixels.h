#pragma once

#include "drivers/trace/trace_format.h"

namespace gazeloop::drivers {

/// CSV of a gaze point on a screen: t_ms, x_px, y_px, from the top left. Its geometry stands in a
/// JSON file beside it (screen_sidecar.h), and without it the trace is refused.
///
/// The point is one for both eyes, which meet at the screen; the head's frame is the screen's
/// (ScreenGeometry).
[[nodiscard]] const TraceFormat& screen_pixels();

}  // namespace gazeloop::drivers
