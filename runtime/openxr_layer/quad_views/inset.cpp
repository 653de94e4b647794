#include "runtime/openxr_layer/quad_views/inset.h"

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

namespace gazeloop::openxr_layer {
namespace {

/// Of the image plane at distance 1.
struct Tangents {
    double left;
    double right;
    double up;
    double down;

    explicit Tangents(const gaze::FieldOfView& fov)
        : left(std::tan(fov.left_rad)),
          right(std::tan(fov.right_rad)),
          up(std::tan(fov.up_rad)),
          down(std::tan(fov.down_rad)) {}
    [[nodiscard]] double width() const { return right - left; }
    [[nodiscard]] double height() const { return up - down; }
};

std::uint32_t scaled(std::uint32_t px, double share) {
    return std::clamp(static_cast<std::uint32_t>(std::lround(px * share)), 1U, std::max(px, 1U));
}

/// How far from the middle of a picture its pixels are fine enough, in degrees: at its optical axis
/// they are coarsest.
double enough_from_deg(double tangents, std::uint32_t outer_px, const foveation::MarLine& line) {
    const double pixel_deg = glm::degrees(tangents / outer_px);
    return std::max(0.0, (2.0 * pixel_deg - line.omega0_deg) / line.slope);
}

std::uint32_t side(double tangents, std::uint32_t full_px, std::uint32_t outer_px,
                   const InsetPolicy& policy) {
    constexpr double kMost_deg = 80.0;
    const double half_deg =
        std::min(enough_from_deg(tangents, outer_px, policy.acuity) + policy.margin_deg, kMost_deg);
    const double share = 2.0 * std::tan(glm::radians(half_deg)) / (tangents * (1.0 - policy.blend));
    return scaled(full_px, std::min(share, 1.0));
}

}  // namespace

PictureSize outer_size(const PictureSize& full, const InsetPolicy& policy) {
    return {scaled(full.width_px, policy.periphery), scaled(full.height_px, policy.periphery)};
}

PictureSize inset_size(const gaze::EyeView& view, const InsetPolicy& policy) {
    const Tangents tangents(view.fov);
    const PictureSize outer = outer_size({view.width_px, view.height_px}, policy);
    return {side(tangents.width(), view.width_px, outer.width_px, policy),
            side(tangents.height(), view.height_px, outer.height_px, policy)};
}

InsetPlace place_inset(const gaze::EyeView& view, const PictureSize& size,
                       const gaze::PixelPosition& fovea) {
    const auto corner = [](double middle_px, std::uint32_t inset_px, std::uint32_t full_px) {
        const double most = static_cast<double>(full_px - inset_px);
        return static_cast<std::uint32_t>(
            std::lround(std::clamp(middle_px - 0.5 * inset_px, 0.0, most)));
    };
    InsetPlace place;
    place.x_px = corner(fovea.x_px, size.width_px, view.width_px);
    place.y_px = corner(fovea.y_px, size.height_px, view.height_px);
    const Tangents tangents(view.fov);
    const auto across = [&](double px) {
        return std::atan(tangents.left + tangents.width() * px / view.width_px);
    };
    const auto down = [&](double px) {
        return std::atan(tangents.up - tangents.height() * px / view.height_px);
    };
    place.fov = {.left_rad = across(place.x_px),
                 .right_rad = across(place.x_px + size.width_px),
                 .up_rad = down(place.y_px),
                 .down_rad = down(place.y_px + size.height_px)};
    return place;
}

PicturePart part_of(const gaze::FieldOfView& whole, const gaze::FieldOfView& inner) {
    const Tangents outer(whole);
    const Tangents part(inner);
    return {.x = (part.left - outer.left) / outer.width(),
            .y = (outer.up - part.up) / outer.height(),
            .width = part.width() / outer.width(),
            .height = part.height() / outer.height()};
}

}  // namespace gazeloop::openxr_layer
