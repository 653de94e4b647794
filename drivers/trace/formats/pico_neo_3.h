#pragma once

#include "drivers/trace/trace_format.h"

namespace gazeloop::drivers {

/// TSV of Pico Neo 3 Pro as a Unity program wrote it: one direction for both eyes (Combine Eye Gaze
/// Vector, +X right, +Y up, +Z forward), each eye's openness, the head's pose in Unity's frame.
/// Foveated Gaze Tracking State vouches for it: 0. Timeline is in seconds.
[[nodiscard]] const TraceFormat& pico_neo_3();

}  // namespace gazeloop::drivers
