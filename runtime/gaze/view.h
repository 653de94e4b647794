#pragma once

#include <cstdint>

#include "runtime/gaze/eye.h"
#include "runtime/gaze/pose.h"

namespace gazeloop::gaze {

/// The four half-angles of an eye's field of view, radians, signed as in XrFovf: left and down are
/// usually negative. Valid when left < right, down < up and all lie inside (-pi/2, pi/2).
struct FieldOfView {
    double left_rad = 0.0;
    double right_rad = 0.0;
    double up_rad = 0.0;
    double down_rad = 0.0;

    friend bool operator==(const FieldOfView&, const FieldOfView&) = default;
};

/// What one eye's picture is rendered from: pose in world, field of view, size.
struct EyeView {
    Pose pose{};
    FieldOfView fov{};
    std::uint32_t width_px = 0;
    std::uint32_t height_px = 0;
};

using StereoView = PerEye<EyeView>;

/// A position in an eye's picture. Origin top-left, pixel centres at +.5, y down.
struct PixelPosition {
    double x_px = 0.0;
    double y_px = 0.0;
};

/// Perspective projection of a direction in the view frame (need not be normalised). A direction
/// beyond the picture gives a position beyond it. A direction at or behind the image plane gives
/// the position that `limit` allows in its direction. The result is always finite and lies within
/// `limit` picture sizes of the picture's centre on each axis (the default reaches 2 sizes past
/// every edge). Where the limit acts, the position keeps its direction from the picture's centre.
/// The result is continuous except straight behind. A direction that is zero or not finite gives
/// the projection of straight ahead. Preconditions: is_valid(view), limit > 0.
[[nodiscard]] PixelPosition project(const glm::dvec3& direction, const EyeView& view,
                                    double limit = 2.5);

/// The unit direction in the view frame that `project` sends to this position (up to rounding),
/// for positions inside its limit. Precondition: is_valid(view).
[[nodiscard]] glm::dvec3 unproject(const PixelPosition& position, const EyeView& view);

/// Whether field of view and size can be used for projection: valid angles whose tangents still
/// differ, and no side of 0 px.
[[nodiscard]] bool is_valid(const EyeView& view);

}  // namespace gazeloop::gaze
