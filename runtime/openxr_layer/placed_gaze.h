#pragma once

#include <glm/vec3.hpp>
#include <optional>

#include "runtime/gaze/pose.h"

namespace gazeloop::openxr_layer {

/// A frame's pose in another, and how fast it moves there: axes of that other frame, m/s and rad/s.
/// What is not known has none.
struct Moving {
    gaze::Pose pose;
    std::optional<glm::dvec3> linear;
    std::optional<glm::dvec3> angular;
};

/// The gaze in the head, and how it turns there.
struct GazeInHead {
    gaze::Pose pose;  ///< -Z along the gaze
    std::optional<glm::dvec3> turning;
};

/// A frame that is fixed to the gaze at `fixed`, where the head is `head`.
[[nodiscard]] Moving place_gaze(const Moving& head, const GazeInHead& gaze,
                                const gaze::Pose& fixed);

/// The other frame in the first one.
[[nodiscard]] Moving inverse(const Moving& moving);

}  // namespace gazeloop::openxr_layer
