#include "runtime/gaze/combined_gaze.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/gaze/direction.h"

namespace gazeloop::gaze {
namespace {

double meeting_m(double distance_m) {
    return distance_m >= kLeastMeeting_m ? distance_m : kLeastMeeting_m;
}

}  // namespace

bool is_in_the_head(const glm::dvec3& place_m) {
    return is_finite(place_m) && glm::length(place_m) <= kFarthestEye_m;
}

glm::dvec3 in_the_head(const glm::dvec3& place_m) {
    return is_in_the_head(place_m) ? place_m : glm::dvec3{0.0};
}

PerEye<EyeRay> eye_rays(const CombinedGaze& gaze, const PerEye<glm::dvec3>& eyes_m,
                        double distance_m) {
    PerEye<EyeRay> rays;
    const auto direction = unit(gaze.direction);
    const double nearness = 1.0 / meeting_m(distance_m);  // 0 at infinity
    for (std::size_t e = 0; e < kEyeCount; ++e) {
        EyeRay& ray = rays[e];
        ray.origin_m = in_the_head(eyes_m[e]);
        if (!direction) {
            continue;
        }
        // Along (origin + distance * direction - eye), scaled so that infinity is no special case.
        const glm::dvec3 aside_m = in_the_head(gaze.origin_m) - ray.origin_m;
        ray.direction = unit(*direction + aside_m * nearness).value_or(*direction);
        ray.valid = true;
    }
    return rays;
}

double parallax_error_rad(const PerEye<glm::dvec3>& eyes_m, double distance_m,
                          const DistanceRange& range) {
    if (!is_in_the_head(eyes_m[0]) || !is_in_the_head(eyes_m[1]) || !(range.nearest_m > 0.0)) {
        return std::numbers::pi;
    }
    const double half_m = glm::length(eyes_m[0] - eyes_m[1]) / 2.0;
    const double at_distance = 1.0 / meeting_m(distance_m);
    const double one_end = 1.0 / range.nearest_m;
    const double other_end = range.farthest_m > 0.0 ? 1.0 / range.farthest_m : 0.0;
    const auto [least, greatest] = std::minmax(one_end, other_end);
    const double u = half_m * std::max(greatest, at_distance);
    if (!(u < 1.0)) {
        return std::numbers::pi;
    }
    const double error_rad =
        half_m / (1.0 - u * u) * std::max(greatest - at_distance, at_distance - least);
    return std::min(error_rad, std::numbers::pi);
}

}  // namespace gazeloop::gaze
