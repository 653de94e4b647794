#include "runtime/light_field/lens.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <numeric>
#include <vector>

namespace gazeloop::light_field {
namespace {

/// A lighter view counts as one that weighs nothing. It is what the rounding of distances makes of
/// cameras that are a whole spacing outside the opening: a lens over a camera asked for its four
/// neighbours too.
constexpr double kLeastWeight = 1e-9;

}  // namespace

double reach_m(const LightField& field) {
    return field.lens.aperture_m + (1.0 - kLeastWeight) * field.cameras.spacing_m;
}

std::uint32_t most_views(const LightField& field) {
    const CameraGrid& cameras = field.cameras;
    // In spacings. Wider by what rounding of distances may do.
    constexpr double kRounding = 1e-12;
    const double radius = reach_m(field) / cameras.spacing_m + kRounding;
    if (field.lens.every_view || radius > std::hypot(cameras.columns, cameras.rows)) {
        return cameras.count();
    }
    // The lens's middle lies between two rows, in one of these steps. A row's chord of the length L
    // holds no more than ceil(L) cameras, wherever it begins.
    constexpr int kSteps = 32;
    const int reach = static_cast<int>(std::ceil(radius));
    std::uint32_t most = 0;
    for (int step = 0; step < kSteps; ++step) {
        std::vector<std::uint32_t> by_row;
        for (int row = -reach; row <= reach + 1; ++row) {
            const double above = static_cast<double>(step) / kSteps - row;
            const double below = row - static_cast<double>(step + 1) / kSteps;
            const double apart = std::max({above, below, 0.0});
            if (apart < radius) {
                const double chord = 2.0 * std::sqrt(radius * radius - apart * apart);
                by_row.push_back(
                    std::min(cameras.columns, static_cast<std::uint32_t>(std::ceil(chord))));
            }
        }
        std::ranges::sort(by_row, std::greater{});
        by_row.resize(std::min<std::size_t>(by_row.size(), cameras.rows));
        most = std::max(most, std::reduce(by_row.begin(), by_row.end()));
    }
    return std::min(most, cameras.count());
}

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
    const double weight = std::clamp(1.0 - outside_m / field_.cameras.spacing_m, 0.0, 1.0);
    return weight < kLeastWeight ? 0.0 : weight;
}

}  // namespace gazeloop::light_field
