#pragma once

#include <cmath>
#include <glm/trigonometric.hpp>
#include <glm/vec3.hpp>
#include <limits>

#include "runtime/gaze/combined_gaze.h"

namespace gazeloop::drivers {

/// The ways in which formats write a direction by two angles, each as a unit vector in our axes
/// (+X right, +Y up, -Z forward). Angles are positive to the right and up, of any size.

/// Azimuth about the vertical, then elevation above the horizontal plane.
[[nodiscard]] inline glm::dvec3 of_azimuth_elevation(double azimuth_rad, double elevation_rad) {
    return {std::cos(elevation_rad) * std::sin(azimuth_rad), std::sin(elevation_rad),
            -std::cos(elevation_rad) * std::cos(azimuth_rad)};
}

/// Horizontal angle out of the median plane, then vertical angle about the axis through both eyes:
/// h = atan2(x, hypot(y, z)), v = atan2(y, z), z forward.
[[nodiscard]] inline glm::dvec3 of_median_angles(double h_rad, double v_rad) {
    return {std::sin(h_rad), std::cos(h_rad) * std::sin(v_rad), -std::cos(h_rad) * std::cos(v_rad)};
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
