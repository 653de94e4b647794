#include "runtime/gaze/view.h"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "runtime/gaze/direction.h"

namespace gazeloop::gaze {
namespace {

/// One axis of the picture: pixel = principal_px + tangent * px_per_tangent.
struct Axis {
    double px_per_tangent;
    double principal_px;  ///< where straight ahead falls
};

/// `first_rad` is the angle of the edge at pixel 0, `last_rad` that of the opposite edge. The slope
/// is negative on the vertical axis, where pixels count down and angles up.
Axis axis(double first_rad, double last_rad, double size_px) {
    const double first = std::tan(first_rad);
    const double px_per_tangent = size_px / (std::tan(last_rad) - first);
    return {px_per_tangent, -first * px_per_tangent};
}

Axis horizontal(const EyeView& view) {
    return axis(view.fov.left_rad, view.fov.right_rad, view.width_px);
}

Axis vertical(const EyeView& view) {
    return axis(view.fov.up_rad, view.fov.down_rad, view.height_px);
}

}  // namespace

PixelPosition project(const glm::dvec3& direction, const EyeView& view, double limit) {
    const double width = view.width_px;
    const double height = view.height_px;
    const Axis across = horizontal(view);
    const Axis down = vertical(view);

    const glm::dvec3 d = unit(direction).value_or(kStraightAhead);

    // The offset from the picture's centre, times the depth. At the image plane it stays finite,
    // and points the way in which the position has gone to infinity. Dividing it by the depth is
    // the projection. Where the offset would pass the limit, it is divided by more, so that it
    // stops on the limit in the same direction. So the result is continuous everywhere but straight
    // behind.
    const double depth = std::max(-d.z, 0.0);
    const double x = d.x * across.px_per_tangent + (across.principal_px - width / 2.0) * depth;
    const double y = d.y * down.px_per_tangent + (down.principal_px - height / 2.0) * depth;
    const double reach_x = limit * width;
    const double reach_y = limit * height;
    const double divisor = std::max({depth, std::abs(x) / reach_x, std::abs(y) / reach_y});
    if (divisor == 0.0) {
        return {width / 2.0 + reach_x, height / 2.0};  // straight behind: any side will do
    }
    return {width / 2.0 + std::clamp(x / divisor, -reach_x, reach_x),
            height / 2.0 + std::clamp(y / divisor, -reach_y, reach_y)};
}

glm::dvec3 unproject(const PixelPosition& position, const EyeView& view) {
    const Axis across = horizontal(view);
    const Axis down = vertical(view);
    return glm::normalize(glm::dvec3{(position.x_px - across.principal_px) / across.px_per_tangent,
                                     (position.y_px - down.principal_px) / down.px_per_tangent,
                                     -1.0});
}

bool is_valid(const EyeView& view) {
    constexpr double kRightAngle = std::numbers::pi / 2.0;
    const FieldOfView& fov = view.fov;
    const bool ordered = -kRightAngle < fov.left_rad && fov.left_rad < fov.right_rad &&
                         fov.right_rad < kRightAngle && -kRightAngle < fov.down_rad &&
                         fov.down_rad < fov.up_rad && fov.up_rad < kRightAngle;
    if (!ordered || view.width_px == 0 || view.height_px == 0) {
        return false;
    }
    // Edges can differ and yet have the same tangent.
    for (const Axis& a : {horizontal(view), vertical(view)}) {
        if (!std::isfinite(a.px_per_tangent) || !std::isfinite(a.principal_px)) {
            return false;
        }
    }
    return true;
}

}  // namespace gazeloop::gaze
