#include "runtime/foveation/picture/screen_wedge.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <limits>

#include "runtime/foveation/picture/segment_part.h"

namespace gazeloop::foveation {
namespace {

double cross(const glm::dvec2& a, const glm::dvec2& b) { return a.x * b.y - a.y * b.x; }

/// Least and greatest distance from the origin of what lies on a segment, gathered.
class Reach {
  public:
    /// The part of the segment between the parameters, 0 at a and 1 at b.
    void include(const glm::dvec2& a, const glm::dvec2& b, double from, double to) {
        const glm::dvec2 along = b - a;
        const double squared = glm::dot(along, along);
        const double foot = squared > 0.0 ? -glm::dot(a, along) / squared : 0.0;
        const double near = glm::length(a + std::clamp(foot, from, to) * along);
        range_.min_px = std::min(range_.min_px, near);
        range_.max_px = std::max(
            {range_.max_px, near, glm::length(a + from * along), glm::length(a + to * along)});
    }
    void include_origin() {
        range_.min_px = 0.0;
        range_.max_px = std::max(range_.max_px, 0.0);
    }
    [[nodiscard]] std::optional<RadiusRange> range() const {
        return range_.max_px < 0.0 ? std::nullopt : std::optional(range_);
    }

  private:
    RadiusRange range_{std::numeric_limits<double>::infinity(), -1.0};
};

}  // namespace

std::optional<RadiusRange> radii_in_wedge(std::span<const glm::dvec2> polygon,
                                          const gaze::PixelPosition& fovea, double from_rad,
                                          double to_rad) {
    const glm::dvec2 origin{fovea.x_px, fovea.y_px};
    const bool all_directions = is_every_direction(from_rad, to_rad);
    const glm::dvec2 first{std::cos(from_rad), std::sin(from_rad)};
    const glm::dvec2 last{std::cos(to_rad), std::sin(to_rad)};

    // What is nearest to the origin or farthest from it lies on an edge, or is the origin itself.
    Reach reach;
    bool left_of_all = true;
    bool right_of_all = true;
    for (std::size_t i = 0; i < polygon.size(); ++i) {
        const glm::dvec2 a = polygon[i] - origin;
        const glm::dvec2 b = polygon[(i + 1) % polygon.size()] - origin;
        const double side = cross(a, b);
        left_of_all = left_of_all && side >= 0.0;
        right_of_all = right_of_all && side <= 0.0;
        SegmentPart part;
        if (!all_directions) {
            part.clip(cross(first, a), cross(first, b));
            part.clip(cross(a, last), cross(b, last));
        }
        if (!part.empty()) {
            reach.include(a, b, part.from, part.to);
        }
    }
    if (left_of_all != right_of_all) {
        reach.include_origin();
    }
    return reach.range();
}

std::optional<RadiusRange> screen_radii_in_wedge(ImageSize image, const gaze::PixelPosition& fovea,
                                                 double from_rad, double to_rad) {
    const double right = image.width_px - 0.5;
    const double bottom = image.height_px - 0.5;
    const std::array<glm::dvec2, 4> corners{glm::dvec2{0.5, 0.5}, glm::dvec2{right, 0.5},
                                            glm::dvec2{right, bottom}, glm::dvec2{0.5, bottom}};
    return radii_in_wedge(corners, fovea, from_rad, to_rad);
}

}  // namespace gazeloop::foveation
