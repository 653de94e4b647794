#include "runtime/quality/acuity_weights.h"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <numeric>

namespace gazeloop::quality {

Plane acuity_weights(const foveation::GazeField& field, const foveation::MarLine& line,
                     const RowWork& work) {
    const gaze::EyeView& view = field.view();
    Plane weights(view.width_px, view.height_px);
    std::vector<double> row_sums(view.height_px);
    const glm::dmat3& gaze_from_picture = field.frame().gaze_from_picture();
    work.over(view.height_px, [&](std::uint32_t from, std::uint32_t to) {
        for (std::uint32_t y = from; y < to; ++y) {
            float* const row = weights.row(y);
            for (std::uint32_t x = 0; x < view.width_px; ++x) {
                // A ray is as long as its pixel is oblique: the solid angle goes with 1 / length^3.
                const double length =
                    glm::length(gaze_from_picture * glm::dvec3(x + 0.5, y + 0.5, 1.0));
                const double omega_deg = line.omega_deg(
                    glm::degrees(field.frame().eccentricity_rad({x + 0.5, y + 0.5})));
                const double weight = 1.0 / (length * length * length * omega_deg * omega_deg);
                row[x] = static_cast<float>(weight);
                row_sums[y] += weight;
            }
        }
    });
    const auto scale =
        static_cast<float>(1.0 / std::accumulate(row_sums.begin(), row_sums.end(), 0.0));
    for (float& weight : weights.values) {
        weight *= scale;
    }
    return weights;
}

Plane equal_weights(std::uint32_t width, std::uint32_t height) {
    Plane weights(width, height);
    const double count = static_cast<double>(width) * height;
    weights.values.assign(weights.values.size(), static_cast<float>(1.0 / count));
    return weights;
}

}  // namespace gazeloop::quality
