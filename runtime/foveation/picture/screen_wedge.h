#pragma once

#include <glm/vec2.hpp>
#include <optional>
#include <span>

#include "runtime/foveation/picture/image_size.h"
#include "runtime/gaze/view.h"

namespace gazeloop::foveation {

/// Least and greatest distance from the fovea.
struct RadiusRange {
    double min_px = 0.0;
    double max_px = 0.0;
};

/// The distances from the fovea at which pixel centres can lie, within a wedge of directions:
/// `from_rad` to `to_rad`, screen angles, y down, to > from. Nothing if the wedge misses the
/// screen. The range is exact for the rectangle that the pixel centres span.
std::optional<RadiusRange> screen_radii_in_wedge(ImageSize image, const gaze::PixelPosition& fovea,
                                                 double from_rad, double to_rad);

/// The same for a convex polygon: its corners in turn, px, clockwise or counter-clockwise. One
/// corner is a point, two are a line. Nothing if there are none.
std::optional<RadiusRange> radii_in_wedge(std::span<const glm::dvec2> polygon,
                                          const gaze::PixelPosition& fovea, double from_rad,
                                          double to_rad);

}  // namespace gazeloop::foveation
