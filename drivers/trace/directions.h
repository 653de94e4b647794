#pragma once

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <numbers>

#include "runtime/gaze/combined_gaze.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::drivers {

/// The ways in which formats write a direction by two angles, each as a unit vector in our axes
/// (+X right, +Y up, -Z forward). Angles are positive to the right and up. One beyond a full turn
/// is no direction of an eye but a damaged number: its direction is not a number.

/// The angle, or not-a-number beyond a full turn.
[[nodiscard]] inline double within_a_turn(double angle_rad) {
    return std::abs(angle_rad) <= 2.0 * std::numbers::pi ? angle_rad
                                                         : std::numeric_limits<double>::quiet_NaN();
}

/// Azimuth about the vertical, then elevation above the horizontal plane.
[[nodiscard]] inline glm::dvec3 of_azimuth_elevation(double azimuth_rad, double elevation_rad) {
    const double a = within_a_turn(azimuth_rad);
    const double e = within_a_turn(elevation_rad);
    return {std::cos(e) * std::sin(a), std::sin(e), -std::cos(e) * std::cos(a)};
}

/// Horizontal angle out of the median plane, then vertical angle about the axis through both eyes:
/// h = atan2(x, hypot(y, z)), v = atan2(y, z), z forward.
[[nodiscard]] inline glm::dvec3 of_median_angles(double h_rad, double v_rad) {
    const double h = within_a_turn(h_rad);
    const double v = within_a_turn(v_rad);
    return {std::sin(h), std::cos(h) * std::sin(v), -std::cos(h) * std::cos(v)};
}

/// A vector whose component is larger is a damaged number, not a direction of other length.
inline constexpr double kMostDirectionComponent = 1e6;

/// Whether a vector as it was written can stand for a direction: shorter or longer than a unit
/// vector, but not beyond kMostDirectionComponent, and not zero.
[[nodiscard]] inline bool is_direction(const glm::dvec3& written) {
    const double largest =
        std::max({std::abs(written.x), std::abs(written.y), std::abs(written.z)});
    return gaze::is_finite(written) && largest > 0.0 && largest <= kMostDirectionComponent;
}

/// How far off an eye's own direction may be where a file has one direction for both eyes, which
/// meet `distance_m` away, or nobody knows where: then between kNearestContent_m and infinity.
/// Pupils are taken to be 63 mm apart, the mean of adults (Dodgson 2004, Proc. SPIE 5291).
[[nodiscard]] inline double combined_parallax_rad(
    double distance_m = std::numeric_limits<double>::quiet_NaN()) {
    constexpr double kHalfApart_m = 0.0315;
    const bool known = distance_m > 0.0;
    return gaze::parallax_error_rad(
        {glm::dvec3{-kHalfApart_m, 0.0, 0.0}, glm::dvec3{kHalfApart_m, 0.0, 0.0}},
        std::numeric_limits<double>::infinity(),
        known ? gaze::DistanceRange{.nearest_m = distance_m, .farthest_m = distance_m}
              : gaze::DistanceRange{});
}

}  // namespace gazeloop::drivers
