#include "runtime/foveation/gaze_field.h"

#include <fmt/core.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>
#include <utility>

#include "runtime/gaze/direction.h"

namespace gazeloop::foveation {
namespace {

bool inside(const gaze::PixelPosition& pixel, const gaze::EyeView& view) {
    return pixel.x_px >= 0.0 && pixel.y_px >= 0.0 && pixel.x_px <= view.width_px &&
           pixel.y_px <= view.height_px;
}

/// The direction, not normalised, towards a point of the picture: z = -1.
glm::dvec3 ray(const gaze::PixelPosition& pixel, const gaze::EyeView& view) {
    const glm::dvec3 unit = gaze::unproject(pixel, view);
    return unit / -unit.z;
}

/// The tangents between which an axis of the picture sees a cone: `across` and `forward` are the
/// cone's axis, of unit length with a third component that does not matter here. The cone touches
/// the plane through the third axis at angle a where the sine of its half-angle is the distance of
/// its axis from that plane.
struct Tangents {
    double low = -std::numeric_limits<double>::infinity();
    double high = std::numeric_limits<double>::infinity();
};

Tangents cone_tangents(double across, double forward, double half_angle_rad) {
    const double sine = std::sin(half_angle_rad) / std::hypot(across, forward);
    if (half_angle_rad >= std::numbers::pi / 2.0 || !(sine < 1.0)) {
        return {};
    }
    const double axis = std::atan2(across, forward);
    const double reach = std::asin(sine);
    constexpr double kRightAngle = std::numbers::pi / 2.0;
    Tangents tangents;
    if (axis - reach >= kRightAngle || axis + reach <= -kRightAngle) {
        return {.low = 1.0, .high = -1.0};  // wholly behind the picture
    }
    if (axis - reach > -kRightAngle) {
        tangents.low = std::tan(axis - reach);
    }
    if (axis + reach < kRightAngle) {
        tangents.high = std::tan(axis + reach);
    }
    return tangents;
}

}  // namespace

Expected<GazeField> GazeField::create(const gaze::EyeView& view, const glm::dvec3& gaze_direction) {
    if (!gaze::is_valid(view) || view.width_px > kMaxSidePx || view.height_px > kMaxSidePx) {
        return std::unexpected(Error{
            ExitCode::Usage,
            fmt::format("a picture of {}x{} px, {} to {} and {} to {} degrees: each side must "
                        "have 1 to {} px, and the angles must rise from left to right and "
                        "from down to up, inside -90 and 90",
                        view.width_px, view.height_px, glm::degrees(view.fov.left_rad),
                        glm::degrees(view.fov.right_rad), glm::degrees(view.fov.down_rad),
                        glm::degrees(view.fov.up_rad), kMaxSidePx)});
    }
    const auto forward = gaze::unit(gaze_direction);
    if (!forward) {
        return std::unexpected(Error{
            ExitCode::Usage, fmt::format("gaze direction {}, {}, {}: must be finite and not zero",
                                         gaze_direction.x, gaze_direction.y, gaze_direction.z)});
    }
    return GazeField(view, *forward);
}

GazeField::GazeField(const gaze::EyeView& view, const glm::dvec3& forward)
    : view_(view), forward_(forward) {
    // Upright: no roll between the picture and the gaze frame, except for a gaze straight up or
    // down, where any will do.
    const bool vertical = std::abs(forward.y) > 1.0 - 1e-9;
    right_ = glm::normalize(
        glm::cross(forward, vertical ? glm::dvec3{0.0, 0.0, 1.0} : glm::dvec3{0.0, 1.0, 0.0}));
    up_ = glm::cross(right_, forward);
    const auto& fov = view.fov;
    px_per_tangent_ = {view.width_px / (std::tan(fov.right_rad) - std::tan(fov.left_rad)),
                       view.height_px / (std::tan(fov.up_rad) - std::tan(fov.down_rad))};
}

double GazeField::eccentricity_rad(const glm::dvec3& direction) const {
    // atan2 keeps its precision at both ends, where acos has none.
    return std::atan2(glm::length(glm::cross(forward_, direction)), glm::dot(forward_, direction));
}

FieldPoint GazeField::point(const glm::dvec3& direction, const gaze::PixelPosition& pixel,
                            double eccentricity_rad, double direction_rad) const {
    const glm::dvec3 outward = std::cos(direction_rad) * right_ + std::sin(direction_rad) * up_;
    const glm::dvec3 radial =
        std::cos(eccentricity_rad) * outward - std::sin(eccentricity_rad) * forward_;
    const glm::dvec3 around = std::cos(direction_rad) * up_ - std::sin(direction_rad) * right_;
    // The pixel position is (x / -z, y / z) times the scale; its change along a unit tangent:
    const auto px_per_deg = [&](const glm::dvec3& tangent) {
        const double z = -direction.z;
        return glm::radians(1.0) *
               glm::dvec2{px_per_tangent_.x * (tangent.x + direction.x / z * tangent.z) / z,
                          -px_per_tangent_.y * (tangent.y + direction.y / z * tangent.z) / z};
    };
    return {.pixel = pixel,
            .eccentricity_deg = glm::degrees(eccentricity_rad),
            .direction_rad = direction_rad,
            .px_per_deg = glm::dmat2(px_per_deg(radial), px_per_deg(around))};
}

FieldPoint GazeField::at(const gaze::PixelPosition& pixel) const {
    const glm::dvec3 direction = gaze::unproject(pixel, view_);
    return point(direction, pixel, eccentricity_rad(direction),
                 std::atan2(glm::dot(direction, up_), glm::dot(direction, right_)));
}

std::optional<FieldPoint> GazeField::at(double eccentricity_deg, double direction_rad) const {
    const double eccentricity = glm::radians(eccentricity_deg);
    const glm::dvec3 direction =
        std::cos(eccentricity) * forward_ +
        std::sin(eccentricity) * (std::cos(direction_rad) * right_ + std::sin(direction_rad) * up_);
    if (direction.z >= 0.0) {
        return std::nullopt;
    }
    const gaze::PixelPosition pixel = gaze::project(direction, view_);
    if (!inside(pixel, view_)) {
        return std::nullopt;
    }
    return point(direction, pixel, eccentricity, direction_rad);
}

double GazeField::pixel_area_deg2(const gaze::PixelPosition& pixel) const {
    const double length = glm::length(ray(pixel, view_));
    const double degree = glm::degrees(1.0);
    return degree * degree / (px_per_tangent_.x * px_per_tangent_.y * length * length * length);
}

double GazeField::least_eccentricity_deg(const gaze::PixelPosition& corner,
                                         const gaze::PixelPosition& opposite) const {
    const double x0 = std::min(corner.x_px, opposite.x_px);
    const double x1 = std::max(corner.x_px, opposite.x_px);
    const double y0 = std::min(corner.y_px, opposite.y_px);
    const double y1 = std::max(corner.y_px, opposite.y_px);
    if (forward_.z < 0.0) {
        const gaze::PixelPosition fovea = this->fovea();
        if (fovea.x_px >= x0 && fovea.x_px <= x1 && fovea.y_px >= y0 && fovea.y_px <= y1) {
            return 0.0;
        }
    }
    // Not inside, so on an edge: at a corner, or where the cosine along the edge,
    // (a + b t) / sqrt(c + d t + e t^2), is stationary, which is at one t.
    const std::array<glm::dvec3, 4> corners{ray({x0, y0}, view_), ray({x1, y0}, view_),
                                            ray({x1, y1}, view_), ray({x0, y1}, view_)};
    double least = std::numbers::pi;
    for (std::size_t i = 0; i < corners.size(); ++i) {
        const glm::dvec3 from = corners[i];
        const glm::dvec3 along = corners[(i + 1) % corners.size()] - from;
        least = std::min(least, eccentricity_rad(from));
        const double a = glm::dot(forward_, from);
        const double b = glm::dot(forward_, along);
        const double c = glm::dot(from, from);
        const double d = 2.0 * glm::dot(from, along);
        const double e = glm::dot(along, along);
        const double divisor = 2.0 * a * e - b * d;
        const double t = divisor != 0.0 ? (2.0 * b * c - a * d) / divisor : 0.0;
        if (t > 0.0 && t < 1.0) {
            least = std::min(least, eccentricity_rad(from + t * along));
        }
    }
    return glm::degrees(least);
}

Tile GazeField::pixels_within(double eccentricity_deg) const {
    const double reach = glm::radians(eccentricity_deg);
    const Tangents across = cone_tangents(forward_.x, -forward_.z, reach);
    const Tangents upward = cone_tangents(forward_.y, -forward_.z, reach);
    if (across.low > across.high || upward.low > upward.high) {
        return {};
    }
    const auto whole = [](double low_px, double high_px, std::uint32_t size) {
        const double first = std::clamp(std::floor(low_px), 0.0, static_cast<double>(size));
        const double end = std::clamp(std::ceil(high_px), first, static_cast<double>(size));
        return std::pair{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end)};
    };
    const auto& fov = view_.fov;
    const auto [x0, x1] =
        whole((across.low - std::tan(fov.left_rad)) * px_per_tangent_.x,
              (across.high - std::tan(fov.left_rad)) * px_per_tangent_.x, view_.width_px);
    const auto [y0, y1] =
        whole((std::tan(fov.up_rad) - upward.high) * px_per_tangent_.y,
              (std::tan(fov.up_rad) - upward.low) * px_per_tangent_.y, view_.height_px);
    if (x0 == x1 || y0 == y1) {
        return {};
    }
    return {x0, y0, x1, y1};
}

double GazeField::greatest_eccentricity_deg() const {
    // What is farthest from the gaze is nearest to its opposite.
    const GazeField opposite(view_, -forward_);
    return 180.0 - opposite.least_eccentricity_deg(
                       {0.0, 0.0},
                       {static_cast<double>(view_.width_px), static_cast<double>(view_.height_px)});
}

}  // namespace gazeloop::foveation
