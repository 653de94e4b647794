#include "runtime/foveation/plans/kfr_density.h"

#include <glm/geometric.hpp>
#include <numbers>

namespace gazeloop::foveation {

KfrDensity::KfrDensity(const LogPolarMap& map, LpSize lp, const gaze::PixelPosition& fovea,
                       double core_px)
    : map_(map), lp_(lp), fovea_(fovea), core_px_(core_px) {}

SampleGrid KfrDensity::at(const FieldPoint& at) const {
    const glm::dvec2 offset_px{at.pixel.x_px - fovea_.x_px, at.pixel.y_px - fovea_.y_px};
    const double radius_px = glm::length(offset_px);
    if (radius_px < core_px_) {
        return SampleGrid::square(1.0).in_degrees(at);
    }
    if (radius_px <= 1.0) {
        return {};  // all these pixels read the first column: nothing tells them apart
    }
    const glm::dvec2 outward = offset_px / radius_px;
    const double rows_per_px = lp_.height / (2.0 * std::numbers::pi * radius_px);
    const double columns_per_px = map_.texels_per_pixel(radius_px, lp_) / rows_per_px;
    return SampleGrid{.first = columns_per_px * outward,
                      .second = rows_per_px * glm::dvec2{-outward.y, outward.x}}
        .in_degrees(at);
}

}  // namespace gazeloop::foveation
