#pragma once

#include <cstdint>

#include "runtime/gaze/pose.h"

namespace gazeloop::gaze {

/// Where the head is in world, at any host time: recorded (HeadTrack) or simulated.
class HeadMotion {
  public:
    HeadMotion() = default;
    HeadMotion(const HeadMotion&) = default;
    HeadMotion& operator=(const HeadMotion&) = default;
    virtual ~HeadMotion() = default;

    /// The same time gives the same pose, in whatever order times are asked.
    [[nodiscard]] virtual Pose at(std::int64_t time_ns) const = 0;
};

}  // namespace gazeloop::gaze
