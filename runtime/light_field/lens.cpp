#include "runtime/light_field/lens.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace gazeloop::light_field {

ViewsInLens::ViewsInLens(const LightField& field, const glm::dvec3& eye_m) : field_(field) {
    const glm::dvec2 half_m = field.cameras.half_extent_m();
    const auto within = [](double value, double half) {
        return std::isnan(value) ? 0.0 : std::clamp(value, -half, half);
    };
    middle_m_ = {within(eye_m.x, half_m.x), within(eye_m.y, half_m.y)};
    for_cameras([&](const WeightedView& view) {
        sum_ += view.weight;
        if (view.weight > 0.0) {
            reach_m_ = std::max(reach_m_, glm::distance(view.camera_m, middle_m_));
        }
    });
}

double ViewsInLens::weight(const glm::dvec2& camera_m) const {
    const double outside_m = glm::distance(camera_m, middle_m_) - field_.lens.aperture_m;
    return std::clamp(1.0 - outside_m / field_.cameras.spacing_m, 0.0, 1.0);
}

}  // namespace gazeloop::light_field
