#pragma once

#include <array>
#include <cstddef>
#include <string>
#include <vector>

#include "runtime/gaze/events/eye_event.h"
#include "runtime/gaze/gaze_trace.h"

namespace gazeloop::bench {

/// How far off, in degrees, gaze is after a time in a headset whose pose is then known.
struct HeadsetErrors {
    std::vector<double> held_in_head;   ///< the last direction, turning with the head
    std::vector<double> held_in_world;  ///< the last direction, by the sample's head pose
    std::vector<double> predicted;      ///< in world, by GazeMotion
};

/// Of each sample of a trace and the first one that lies `ahead_ns` or more, 12 ms more at most,
/// after it, by what the event detector says of that one (the coders have seen no headset's trace):
/// index number less one. Samples without gaze of both or a head pose are left out.
[[nodiscard]] std::array<HeadsetErrors, gaze::kEyeEventNames.size()> headset_errors(
    const gaze::GazeTrace& trace, std::int64_t ahead_ns);

}  // namespace gazeloop::bench
