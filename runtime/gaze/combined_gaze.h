#pragma once

#include <limits>

#include "runtime/gaze/gaze_sample.h"

namespace gazeloop::gaze {

/// One ray for both eyes, in the head frame: what a tracker gives that does not tell the eyes
/// apart.
struct CombinedGaze {
    glm::dvec3 origin_m{0.0};  ///< somewhere between the eyes
    glm::dvec3 direction{0.0, 0.0, -1.0};
};

/// The nearest that headsets' content is taken to be when the error of a combined gaze is stated.
/// Most people cannot look at anything nearer for long.
inline constexpr double kNearestContent_m = 0.5;

/// Rays from both eyes that meet where the combined ray is `distance_m` from its origin; the eyes
/// are at `eyes_m`. They are parallel for an infinite distance. A distance that is not a number or
/// less than kLeastMeeting_m counts as kLeastMeeting_m. An origin or an eye outside the head
/// (is_in_the_head) counts as the head's own origin. A ray is valid if the direction is finite and
/// not zero; it may point behind the head.
[[nodiscard]] PerEye<EyeRay> eye_rays(const CombinedGaze& gaze, const PerEye<glm::dvec3>& eyes_m,
                                      double distance_m);
inline constexpr double kLeastMeeting_m = 0.05;

/// Whether a position is finite and lies within kFarthestEye_m of the head's origin.
[[nodiscard]] bool is_in_the_head(const glm::dvec3& place_m);
inline constexpr double kFarthestEye_m = 0.25;

/// The position, or the head's own origin where it is outside the head.
[[nodiscard]] glm::dvec3 in_the_head(const glm::dvec3& place_m);

/// The distances between which something is; `farthest_m` may be infinite.
struct DistanceRange {
    double nearest_m = kNearestContent_m;
    double farthest_m = std::numeric_limits<double>::infinity();
};

/// By how much an eye may look elsewhere than `eye_rays` says, because what it looks at may be at
/// any distance of a range. The range need not hold `distance_m`. An eye at h, half the distance
/// between the eyes, turns by phi to see a point at z. With u = h / z and the gaze at an angle t to
/// straight ahead, dphi / du = cos t / (1 - 2 u sin t + u^2). That is at most 1 / (1 - u^2) for any
/// t. So with the greatest u of range and distance:
///
///     error <= h / (1 - u^2) max(1 / nearest - 1 / distance, 1 / distance - 1 / farthest)
///
/// Radians; pi where u is 1 or more, or an eye is outside the head. A nearest distance that is not
/// a number, zero or less gives pi, because it says nothing; such a farthest distance counts as
/// infinite. Preconditions: as eye_rays, for an origin midway between the eyes.
[[nodiscard]] double parallax_error_rad(const PerEye<glm::dvec3>& eyes_m, double distance_m,
                                        const DistanceRange& range);

}  // namespace gazeloop::gaze
