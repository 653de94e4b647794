#include "runtime/foveation/picture/gaze_frame.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

#include "runtime/foveation/picture/angles.h"
#include "runtime/foveation/picture/segment_part.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::foveation {
namespace {

constexpr double kPi = std::numbers::pi;

/// tan(e / 2) of a ray; no cancellation before and behind.
double rho_of(const glm::dvec3& ray) {
    const double across = std::hypot(ray.x, ray.y);
    const double length = glm::length(ray);
    return ray.z >= 0.0 ? across / (length + ray.z) : (length - ray.z) / across;
}

/// (x_px, y_px, 1) to the ray (tangents, -1) in the view frame.
glm::dmat3 view_from_picture(const gaze::EyeView& view) {
    const glm::dvec2 tangents = 1.0 / px_per_tangent(view);
    return {glm::dvec3(tangents.x, 0.0, 0.0), glm::dvec3(0.0, tangents.y, 0.0),
            glm::dvec3(std::tan(view.fov.left_rad), std::tan(view.fov.up_rad), -1.0)};
}

/// Right, down and forward of a gaze, in the view frame: the smallest rotation from straight ahead.
glm::dmat3 axes_of(const glm::dvec3& gaze) {
    const double away = 1.0 - gaze.z;  // 1 + cosine of the angle from straight ahead, (0, 0, -1)
    if (away < 1e-6) {                 // straight behind, where no rotation is the smallest
        return {glm::dvec3(1.0, 0.0, 0.0), glm::dvec3(0.0, 1.0, 0.0), glm::dvec3(0.0, 0.0, 1.0)};
    }
    const double xy = gaze.x * gaze.y / away;
    return {glm::dvec3(1.0 - gaze.x * gaze.x / away, -xy, gaze.x),
            glm::dvec3(xy, -1.0 + gaze.y * gaze.y / away, -gaze.y), gaze};
}

}  // namespace

GazeFrame::GazeFrame(const gaze::EyeView& view, const glm::dvec3& gaze)
    : view_(view),
      view_from_gaze_(axes_of(gaze::unit(gaze).value_or(gaze::kStraightAhead))),
      gaze_from_picture_(glm::transpose(view_from_gaze_) * view_from_picture(view)) {}

glm::dvec3 GazeFrame::nearest_in_view() const {
    const gaze::PixelPosition at = gaze::project(view_from_gaze_[2], view_);
    return gaze::unproject({std::clamp(at.x_px, 0.0, static_cast<double>(view_.width_px)),
                            std::clamp(at.y_px, 0.0, static_cast<double>(view_.height_px))},
                           view_);
}

GazePolar GazeFrame::polar(const gaze::PixelPosition& position) const {
    const glm::dvec3 at = ray(position.x_px, position.y_px);
    double angle = std::atan2(at.y, at.x);
    angle = angle < 0.0 ? angle + 2.0 * kPi : angle;
    return {rho_of(at), angle < 2.0 * kPi ? angle : 0.0};
}

double GazeFrame::eccentricity_rad(const gaze::PixelPosition& position) const {
    return 2.0 * std::atan(rho_of(ray(position.x_px, position.y_px)));
}

std::optional<gaze::PixelPosition> GazeFrame::position(const GazePolar& polar) const {
    const double eccentricity = 2.0 * std::atan(polar.rho);
    const glm::dvec3 direction =
        view_from_gaze_ * glm::dvec3(std::sin(eccentricity) * std::cos(polar.angle_rad),
                                     std::sin(eccentricity) * std::sin(polar.angle_rad),
                                     std::cos(eccentricity));
    if (direction.z >= -1e-12) {
        return std::nullopt;
    }
    const glm::dvec2 scale = px_per_tangent(view_);
    return gaze::PixelPosition{
        (direction.x / -direction.z - std::tan(view_.fov.left_rad)) * scale.x,
        (direction.y / -direction.z - std::tan(view_.fov.up_rad)) * scale.y};
}

std::optional<GazeFrame::RhoRange> GazeFrame::rho_in_wedge(std::span<const glm::dvec2> polygon,
                                                           double from_rad, double to_rad) const {
    // A row's directions are a half-plane through the gaze, which cuts the picture in a line. So
    // two lines cut the wedge between two rows out of the polygon.
    const bool all_directions = is_every_direction(from_rad, to_rad);
    const glm::dvec3 after_first{-std::sin(from_rad), std::cos(from_rad), 0.0};
    const glm::dvec3 before_last{std::sin(to_rad), -std::cos(to_rad), 0.0};

    // On the sphere, eccentricity has extremes only at the gaze and opposite of it, and it has none
    // along the wedge's sides. So its extremes over the part in the wedge lie on the polygon's
    // edges, or at the gaze, or at the point opposite of it, if these are inside.
    RhoRange range{std::numeric_limits<double>::infinity(), -1.0};
    const auto include = [&](const glm::dvec3& at) {
        const double rho = rho_of(at);
        range.min = std::min(range.min, rho);
        range.max = std::max(range.max, rho);
    };
    bool gaze_inside = true;
    bool opposite_inside = true;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2& from = polygon[i];
        const glm::dvec2& to = polygon[(i + 1) % polygon.size()];
        const glm::dvec3 a = ray(from.x, from.y);
        const glm::dvec3 end = ray(to.x, to.y);
        const glm::dvec3 b = end - a;
        // The side of the edge's plane that the gaze is on; corners go round as angles do.
        const double side = a.x * b.y - a.y * b.x;
        gaze_inside = gaze_inside && side >= 0.0;
        opposite_inside = opposite_inside && side <= 0.0;
        SegmentPart part;
        if (!all_directions) {
            part.clip(glm::dot(after_first, a), glm::dot(after_first, end));
            part.clip(glm::dot(before_last, a), glm::dot(before_last, end));
        }
        if (part.empty()) {
            continue;
        }
        include(a + part.from * b);
        include(a + part.to * b);
        // A straight edge is an arc of a great circle. Along it, the cosine of eccentricity has one
        // extreme. (a.z and b.z are components along the gaze.)
        const double aa = glm::dot(a, a);
        const double ab = glm::dot(a, b);
        const double bb = glm::dot(b, b);
        const double t = (b.z * aa - a.z * ab) / (a.z * bb - b.z * ab);
        if (t > part.from && t < part.to) {
            include(a + t * b);
        }
    }
    if (range.max < 0.0) {
        return std::nullopt;
    }
    if (gaze_inside) {
        range.min = 0.0;
    }
    if (opposite_inside) {
        range.max = std::numeric_limits<double>::infinity();
    }
    return range;
}

std::optional<GazeFrame::RhoRange> GazeFrame::on_screen(double from_rad, double to_rad) const {
    const double right = view_.width_px - 0.5;
    const double bottom = view_.height_px - 0.5;
    const std::array<glm::dvec2, 4> corners{glm::dvec2{0.5, 0.5}, glm::dvec2{right, 0.5},
                                            glm::dvec2{right, bottom}, glm::dvec2{0.5, bottom}};
    return rho_in_wedge(corners, from_rad, to_rad);
}

GazeFrame::RhoRange GazeFrame::rho_over(const gaze::PixelPosition& corner,
                                        const gaze::PixelPosition& opposite) const {
    const auto [x0, x1] = std::minmax(corner.x_px, opposite.x_px);
    const auto [y0, y1] = std::minmax(corner.y_px, opposite.y_px);
    const std::array<glm::dvec2, 4> corners{glm::dvec2{x0, y0}, glm::dvec2{x1, y0},
                                            glm::dvec2{x1, y1}, glm::dvec2{x0, y1}};
    return *rho_in_wedge(corners, 0.0, 2.0 * kPi);
}

std::optional<GazeFrame::RowSpan> GazeFrame::row_within(double y_px,
                                                        double eccentricity_rad) const {
    const double first = 0.5;
    const double last = view_.width_px - 0.5;
    if (eccentricity_rad >= kPi / 2.0) {
        return RowSpan{first, last};
    }
    // The row is a line in space, a + b x. Seen from the eye it is half a great circle. Let theta
    // be the angle on it from the line's foot, which is the point nearest to the eye. The gaze's
    // projection into the circle's plane has length g and lies at theta0. Then the cosine of
    // eccentricity is g cos(theta - theta0).
    const glm::dvec3 a = gaze_from_picture_ * glm::dvec3(0.0, y_px, 1.0);
    const glm::dvec3 b = gaze_from_picture_[0];
    const double per_px = glm::length(b);
    const double foot_x = -glm::dot(a, b) / (per_px * per_px);
    const glm::dvec3 foot = a + foot_x * b;
    const double distance = glm::length(foot);
    const double along = b.z / per_px;
    const double toward = foot.z / distance;
    const double g = std::hypot(along, toward);
    const double cosine = std::cos(eccentricity_rad);
    if (!(cosine <= g)) {
        return std::nullopt;
    }
    const double theta0 = std::atan2(along, toward);
    const double reach = std::acos(cosine / g);
    const auto x_at = [&](double theta) {
        if (theta >= kPi / 2.0 || theta <= -kPi / 2.0) {
            return std::copysign(std::numeric_limits<double>::infinity(), theta);
        }
        return foot_x + distance / per_px * std::tan(theta);
    };
    const double from = std::max(x_at(theta0 - reach), first);
    const double to = std::min(x_at(theta0 + reach), last);
    if (!(from <= to)) {
        return std::nullopt;
    }
    return RowSpan{from, to};
}

glm::dvec2 px_per_tangent(const gaze::EyeView& view) {
    const gaze::FieldOfView& fov = view.fov;
    return {view.width_px / (std::tan(fov.right_rad) - std::tan(fov.left_rad)),
            view.height_px / (std::tan(fov.down_rad) - std::tan(fov.up_rad))};
}

PixelsPerDegree pixels_per_degree(const gaze::EyeView& view, const glm::dvec3& direction) {
    const glm::dvec2 scale_px = px_per_tangent(view);
    const double per_x = scale_px.x;
    const double per_y = -scale_px.y;
    const double x = direction.x / -direction.z;
    const double y = direction.y / -direction.z;
    // The metric of directions, pulled back to tangents x, y, has the inverse
    // (1 + x^2 + y^2) [[1 + x^2, x y], [x y, 1 + y^2]]. Scaled to pixels, the eigenvalues of this
    // inverse are the squares of pixels per radian.
    const double scale = 1.0 + x * x + y * y;
    const double xx = scale * (1.0 + x * x) * per_x * per_x;
    const double yy = scale * (1.0 + y * y) * per_y * per_y;
    const double xy = scale * x * y * per_x * per_y;
    const double half_sum = 0.5 * (xx + yy);
    const double greatest = half_sum + std::hypot(0.5 * (xx - yy), xy);
    const double mean = std::sqrt(per_x * per_y * scale * std::sqrt(scale));
    return {std::sqrt(greatest) * kRadiansPerDegree, mean * kRadiansPerDegree};
}

double most_pixels_per_degree(const gaze::EyeView& view) {
    double most = 0.0;
    for (const double x : {std::tan(view.fov.left_rad), std::tan(view.fov.right_rad)}) {
        for (const double y : {std::tan(view.fov.up_rad), std::tan(view.fov.down_rad)}) {
            most = std::max(most, pixels_per_degree(view, {x, y, -1.0}).finest);
        }
    }
    return most;
}

}  // namespace gazeloop::foveation
