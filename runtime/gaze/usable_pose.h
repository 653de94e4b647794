#pragma once

#include <cmath>
#include <optional>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/pose.h"

namespace gazeloop::gaze {

/// The pose with a unit quaternion; none where there is none, or it is not finite or no rotation.
[[nodiscard]] inline std::optional<Pose> usable_pose(const std::optional<Pose>& pose) {
    if (!pose || !is_finite(pose->position_m)) {
        return std::nullopt;
    }
    const double length = glm::length(pose->orientation);
    if (!std::isfinite(length) || length == 0.0) {
        return std::nullopt;
    }
    return Pose{pose->orientation / length, pose->position_m};
}

}  // namespace gazeloop::gaze
