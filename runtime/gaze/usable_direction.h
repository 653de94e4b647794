#pragma once

#include <optional>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::gaze {

/// Where a valid eye looks, a unit vector: one that the tracker vouches for, whose direction is
/// finite and not zero, and whose confidence is unknown or high enough. Else none.
[[nodiscard]] inline std::optional<glm::dvec3> usable_direction(const EyeRay& ray,
                                                                double minimum_confidence) {
    const bool confident = ray.confidence == -1.0 || ray.confidence >= minimum_confidence;
    if (!ray.valid || !confident) {
        return std::nullopt;
    }
    return unit(ray.direction);
}

}  // namespace gazeloop::gaze
