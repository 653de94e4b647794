#include "runtime/foveation/screen_wedge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/vec2.hpp>
#include <limits>
#include <numbers>

namespace gazeloop::foveation {
namespace {

struct Box {
    glm::dvec2 low;
    glm::dvec2 high;
};

/// The part of the ray from the origin that lies in the box (slab method).
std::optional<RadiusRange> clip_ray(const Box& box, const glm::dvec2& direction) {
    double enter = 0.0;
    double leave = std::numeric_limits<double>::infinity();
    for (int axis = 0; axis < 2; ++axis) {
        if (direction[axis] == 0.0) {
            if (box.low[axis] > 0.0 || box.high[axis] < 0.0) {
                return std::nullopt;
            }
            continue;
        }
        const double a = box.low[axis] / direction[axis];
        const double b = box.high[axis] / direction[axis];
        enter = std::max(enter, std::min(a, b));
        leave = std::min(leave, std::max(a, b));
    }
    if (enter > leave) {
        return std::nullopt;
    }
    return RadiusRange{enter, leave};
}

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

}  // namespace

std::optional<RadiusRange> screen_radii_in_wedge(ImageSize image, const gaze::PixelPosition& fovea,
                                                 double from_rad, double to_rad) {
    const glm::dvec2 origin{fovea.x_px, fovea.y_px};
    const Box box{glm::dvec2{0.5, 0.5} - origin,
                  glm::dvec2{image.width_px - 0.5, image.height_px - 0.5} - origin};
    const std::array<glm::dvec2, 4> corners{box.low, glm::dvec2{box.high.x, box.low.y}, box.high,
                                            glm::dvec2{box.low.x, box.high.y}};
    const glm::dvec2 nearest{std::clamp(0.0, box.low.x, box.high.x),
                             std::clamp(0.0, box.low.y, box.high.y)};
    // Half a turn or more is not convex any more: take every direction.
    const bool all_directions = to_rad - from_rad >= std::numbers::pi * 0.999;
    const glm::dvec2 first{std::cos(from_rad), std::sin(from_rad)};
    const glm::dvec2 last{std::cos(to_rad), std::sin(to_rad)};

    RadiusRange range{std::numeric_limits<double>::infinity(), -1.0};
    const auto include = [&](double radius) {
        range.min_px = std::min(range.min_px, radius);
        range.max_px = std::max(range.max_px, radius);
    };
    const auto include_point = [&](const glm::dvec2& point) {
        if (all_directions || (cross(first, point) >= 0.0 && cross(point, last) >= 0.0)) {
            include(glm::length(point));
        }
    };
    for (const glm::dvec2& corner : corners) {
        include_point(corner);
    }
    include_point(nearest);
    if (!all_directions) {
        for (const glm::dvec2& direction : {first, last}) {
            if (const auto clipped = clip_ray(box, direction)) {
                include(clipped->min_px);
                include(clipped->max_px);
            }
        }
    }
    if (range.max_px < 0.0) {
        return std::nullopt;
    }
    return range;
}

}  // namespace gazeloop::foveation
