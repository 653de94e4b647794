#pragma once

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec3.hpp>

namespace gazeloop::sim {

/// A unit vector at right angles to `direction` (unit), horizontal unless `direction` is vertical,
/// and to its right.
[[nodiscard]] inline glm::dvec3 right_of(const glm::dvec3& direction) {
    const glm::dvec3 across{-direction.z, 0.0, direction.x};  // direction x up
    const double length = std::hypot(across.x, across.z);
    return length > 1e-9 ? across / length : glm::dvec3{1.0, 0.0, 0.0};
}

/// The unit vector that is `right_rad` to the right of `direction` (unit) and `up_rad` above it,
/// along the great circle of that offset. Any finite offset; its length is the angle between the
/// two vectors.
[[nodiscard]] inline glm::dvec3 turned_direction(const glm::dvec3& direction, double right_rad,
                                                 double up_rad) {
    const double angle = std::hypot(right_rad, up_rad);
    if (angle == 0.0) {
        return direction;
    }
    const glm::dvec3 right = right_of(direction);
    const glm::dvec3 up = glm::cross(right, direction);
    const glm::dvec3 aside = (right * right_rad + up * up_rad) / angle;
    return glm::normalize(direction * std::cos(angle) + aside * std::sin(angle));
}

}  // namespace gazeloop::sim
