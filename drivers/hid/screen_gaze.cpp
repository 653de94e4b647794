#include "drivers/hid/screen_gaze.h"

#include <algorithm>

#include "runtime/gaze/direction.h"

namespace gazeloop::drivers::hid {
namespace {

using gaze::Eye;
using gaze::index;

/// +Y down to +Y up; +X and +Z are the same.
glm::dvec3 to_head_axes(const glm::dvec3& screen) { return {screen.x, -screen.y, screen.z}; }

double side(Eye eye) { return eye == Eye::Left ? -0.5 : 0.5; }

}  // namespace

gaze::PerEye<gaze::EyeRay> eye_rays(const TrackingReport& report, const ScreenGeometry& geometry) {
    gaze::PerEye<std::optional<glm::dvec3>> eyes = report.eye_m;
    if (!eyes[0] && !eyes[1] && geometry.complete()) {
        for (const Eye eye : gaze::kEyes) {
            eyes[index(eye)] = {geometry.width_m / 2.0 + side(eye) * geometry.eye_distance_m,
                                geometry.height_m / 2.0, geometry.viewing_distance_m};
        }
    }
    gaze::PerEye<gaze::EyeRay> rays;
    for (const Eye eye : gaze::kEyes) {
        const auto& own = eyes[index(eye)];
        const auto& others = eyes[index(gaze::other(eye))];
        gaze::EyeRay& ray = rays[index(eye)];
        const glm::dvec3 aside{side(eye) * geometry.eye_distance_m, 0.0, 0.0};
        ray.origin_m = own && others ? to_head_axes(*own - *others) / 2.0 : aside;
        if (!own || !report.gaze_m || own->z <= 0.0) {
            continue;
        }
        const auto direction = gaze::unit(to_head_axes(glm::dvec3(*report.gaze_m, 0.0) - *own));
        ray.valid = direction.has_value();
        ray.direction = direction.value_or(gaze::kStraightAhead);
    }
    return rays;
}

std::optional<std::string> geometry_problem(const EyeTrackerLayout& layout,
                                            const ScreenGeometry& geometry) {
    const bool any_eye = std::ranges::any_of(layout.tracking, [](const TrackingLayout& tracking) {
        return tracking.has_eye(Eye::Left) || tracking.has_eye(Eye::Right);
    });
    if (any_eye || geometry.complete()) {
        return std::nullopt;
    }
    std::string problem =
        "the tracker gives points on a screen but not where the eyes are: a direction needs the "
        "viewing distance (--set hid.viewing_distance_m=0.6)";
    if (geometry.width_m <= 0.0 || geometry.height_m <= 0.0) {
        problem +=
            " and the screen's size, which the tracker does not state either (--set "
            "hid.screen_width_m=0.53 --set hid.screen_height_m=0.30)";
    }
    return problem;
}

}  // namespace gazeloop::drivers::hid
