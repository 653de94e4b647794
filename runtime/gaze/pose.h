#pragma once

#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>

namespace gazeloop::gaze {

/// A rigid pose, right-handed, axes as OpenXR has them: +X right, +Y up, -Z forward. Maps the local
/// frame into the frame it is given in. The orientation is a unit quaternion, positions are metres.
struct Pose {
    glm::dquat orientation{1.0, 0.0, 0.0, 0.0};
    glm::dvec3 position_m{0.0};
};

/// `outer` after `inner`: the pose that maps through inner first.
[[nodiscard]] inline Pose compose(const Pose& outer, const Pose& inner) {
    return {outer.orientation * inner.orientation,
            outer.position_m + outer.orientation * inner.position_m};
}

[[nodiscard]] inline Pose inverse(const Pose& pose) {
    const glm::dquat back = glm::conjugate(pose.orientation);
    return {back, back * -pose.position_m};
}

/// A point given in the pose's local frame, in the frame the pose is given in.
[[nodiscard]] inline glm::dvec3 transform_point(const Pose& pose, const glm::dvec3& point_m) {
    return pose.position_m + pose.orientation * point_m;
}

}  // namespace gazeloop::gaze
