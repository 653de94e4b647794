#include "runtime/foveation/picture/gaze_field.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
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

double eccentricity_deg(double rho) { return glm::degrees(2.0 * std::atan(rho)); }

/// The range of tangents that a cone covers on one axis of the picture. `across` and `forward` are
/// components of the cone's axis, a unit vector whose third component does not matter here. Take
/// the planes through the third axis, by their angle a. The cone touches one where the sine of its
/// half-angle equals the distance of its axis (a unit vector) from that plane.
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
            ErrorKind::Usage,
            fmt::format("a picture of {}x{} px, {} to {} and {} to {} degrees: each side must "
                        "have 1 to {} px, and the angles must rise from left to right and "
                        "from down to up, inside -90 and 90",
                        view.width_px, view.height_px, glm::degrees(view.fov.left_rad),
                        glm::degrees(view.fov.right_rad), glm::degrees(view.fov.down_rad),
                        glm::degrees(view.fov.up_rad), kMaxSidePx)});
    }
    if (!gaze::unit(gaze_direction)) {
        return std::unexpected(Error{
            ErrorKind::Usage, fmt::format("gaze direction {}, {}, {}: must be finite and not zero",
                                          gaze_direction.x, gaze_direction.y, gaze_direction.z)});
    }
    return GazeField(GazeFrame(view, gaze_direction));
}

FieldPoint GazeField::point(const gaze::PixelPosition& pixel, const GazePolar& polar) const {
    const glm::dmat3& axes = frame_.view_from_gaze();  // right, down, forward
    const double eccentricity_rad = 2.0 * std::atan(polar.rho);
    const double cosine = std::cos(polar.angle_rad);
    const double sine = std::sin(polar.angle_rad);
    const glm::dvec3 outward = cosine * axes[0] + sine * axes[1];
    const glm::dvec3 radial =
        std::cos(eccentricity_rad) * outward - std::sin(eccentricity_rad) * axes[2];
    const glm::dvec3 around = sine * axes[0] - cosine * axes[1];
    const glm::dvec3 direction = gaze::unproject(pixel, view());
    const glm::dvec2 scale = px_per_tangent(view());
    // The pixel position is (x, y) / -z times the scale; its change along a unit tangent:
    const auto px_per_deg = [&](const glm::dvec3& tangent) {
        const double z = -direction.z;
        return glm::radians(1.0) *
               glm::dvec2{scale.x * (tangent.x + direction.x / z * tangent.z) / z,
                          scale.y * (tangent.y + direction.y / z * tangent.z) / z};
    };
    return {.pixel = pixel,
            .eccentricity_deg = glm::degrees(eccentricity_rad),
            .direction_rad = std::remainder(-polar.angle_rad, 2.0 * std::numbers::pi),
            .px_per_deg = glm::dmat2(px_per_deg(radial), px_per_deg(around))};
}

FieldPoint GazeField::at(const gaze::PixelPosition& pixel) const {
    return point(pixel, frame_.polar(pixel));
}

std::optional<FieldPoint> GazeField::at(double eccentricity_deg, double direction_rad) const {
    const GazePolar polar{std::tan(0.5 * glm::radians(eccentricity_deg)), -direction_rad};
    const auto pixel = frame_.position(polar);
    if (!pixel || !inside(*pixel, view())) {
        return std::nullopt;
    }
    return point(*pixel, polar);
}

double GazeField::pixel_area_deg2(const gaze::PixelPosition& pixel) const {
    const double per_deg = pixels_per_degree(view(), gaze::unproject(pixel, view())).mean;
    return 1.0 / (per_deg * per_deg);
}

double GazeField::least_eccentricity_deg(const gaze::PixelPosition& corner,
                                         const gaze::PixelPosition& opposite) const {
    return eccentricity_deg(frame_.rho_over(corner, opposite).min);
}

Tile GazeField::pixels_within(double eccentricity_deg) const {
    const double reach = glm::radians(eccentricity_deg);
    const Tangents across = cone_tangents(gaze().x, -gaze().z, reach);
    const Tangents upward = cone_tangents(gaze().y, -gaze().z, reach);
    if (across.low > across.high || upward.low > upward.high) {
        return {};
    }
    const auto whole = [](double low_px, double high_px, std::uint32_t size) {
        const double first = std::clamp(std::floor(low_px), 0.0, static_cast<double>(size));
        const double end = std::clamp(std::ceil(high_px), first, static_cast<double>(size));
        return std::pair{static_cast<std::uint32_t>(first), static_cast<std::uint32_t>(end)};
    };
    const auto& fov = view().fov;
    const glm::dvec2 scale = px_per_tangent(view());
    const auto [x0, x1] = whole((across.low - std::tan(fov.left_rad)) * scale.x,
                                (across.high - std::tan(fov.left_rad)) * scale.x, view().width_px);
    const auto [y0, y1] = whole((upward.high - std::tan(fov.up_rad)) * scale.y,
                                (upward.low - std::tan(fov.up_rad)) * scale.y, view().height_px);
    if (x0 == x1 || y0 == y1) {
        return {};
    }
    return {x0, y0, x1, y1};
}

double GazeField::greatest_eccentricity_deg() const {
    return eccentricity_deg(frame_
                                .rho_over({0.0, 0.0}, {static_cast<double>(view().width_px),
                                                       static_cast<double>(view().height_px)})
                                .max);
}

}  // namespace gazeloop::foveation
