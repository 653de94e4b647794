#pragma once

#include <array>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/gaze/pose.h"

namespace gazeloop::drivers {

/// A pose as programs made with Unity write it, in our axes: x, y, z in metres, then rotations in
/// degrees about x, y and z, which are done about z, then x, then y of the world.
///
/// Unity's left-handed frame is mirrored in z: positions change sign in z, and a mirror in z turns
/// rotations about x and y around, but not those about z.
[[nodiscard]] inline gaze::Pose pose_of_unity(const std::array<double, 6>& unity) {
    const auto turn = [](double angle_deg, const glm::dvec3& axis) {
        return glm::angleAxis(glm::radians(angle_deg), axis);
    };
    const glm::dquat turned = turn(unity[4], {0.0, 1.0, 0.0}) * turn(unity[3], {1.0, 0.0, 0.0}) *
                              turn(unity[5], {0.0, 0.0, 1.0});
    return {glm::normalize(glm::dquat{turned.w, -turned.x, -turned.y, turned.z}),
            {unity[0], unity[1], -unity[2]}};
}

}  // namespace gazeloop::drivers
