#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::gaze {

/// The two axes on which a direction's error is stated: unit vectors at a right angle to the
/// direction and to each other.
struct ErrorAxes {
    glm::dvec3 across;  ///< level, to the right of who looks that way
    glm::dvec3 up;
};

/// Of a unit vector in the head frame. Straight up or down no level axis is the right one: there it
/// is the head's +X.
[[nodiscard]] inline ErrorAxes error_axes(const glm::dvec3& direction) {
    const glm::dvec3 level{-direction.z, 0.0, direction.x};
    const glm::dvec3 across = unit(level).value_or(glm::dvec3{1.0, 0.0, 0.0});
    return {across, glm::cross(across, direction)};
}

/// The part of independent errors along X, Y and Z (variances, not negative) that turns the
/// direction; what lengthens it counts for nothing.
[[nodiscard]] inline DirectionCovariance turning_part(const glm::dvec3& direction,
                                                      const glm::dvec3& variances) {
    const auto [across, up] = error_axes(direction);
    return {glm::dot(across * across, variances), glm::dot(across * up, variances),
            glm::dot(up * up, variances)};
}

/// The SD along the axis where it is greatest, radians: the square root of the greater eigenvalue.
[[nodiscard]] inline double greatest_sd_rad(const DirectionCovariance& c) {
    const double middle = 0.5 * (c.xx_rad2 + c.yy_rad2);
    const double spread = std::hypot(0.5 * (c.xx_rad2 - c.yy_rad2), c.xy_rad2);
    return std::sqrt(middle + spread);
}

}  // namespace gazeloop::gaze
