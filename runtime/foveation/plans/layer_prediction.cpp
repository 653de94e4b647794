#include "runtime/foveation/plans/layer_prediction.h"

#include <fmt/core.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <utility>

namespace gazeloop::foveation {

LayerDisplay foveal_display(double fov_deg, const MarLine& line) {
    const double half = std::tan(glm::radians(fov_deg / 2.0));
    return {.half_width_tangent = half,
            .width_px = 4.0 * half / std::tan(glm::radians(line.omega0_deg)),
            .aspect = 0.75};
}

Expected<LayerPrediction> predict_layers(double fov_deg, const MarLine& line,
                                         const LayerOptions& options) {
    if (!(fov_deg >= 1.0 && fov_deg <= 179.0)) {
        return std::unexpected(
            Error{ErrorKind::Usage,
                  fmt::format("field of view = {} degrees: must lie in [1, 179]", fov_deg)});
    }
    const auto layers = optimise_layers(foveal_display(fov_deg, line), line, options);
    if (!layers) {
        return std::unexpected(layers.error());
    }
    return LayerPrediction{layers->display_pixels, layers->work};
}

Expected<CostGrowth> layer_cost_growth(double from_deg, double to_deg, const MarLine& line,
                                       const LayerOptions& options) {
    constexpr int kPoints = 29;
    std::vector<std::pair<double, double>> costs;
    for (int i = 0; i < kPoints; ++i) {
        const double fov = std::lerp(from_deg, to_deg, i / (kPoints - 1.0));
        const auto prediction = predict_layers(fov, line, options);
        if (!prediction) {
            return std::unexpected(prediction.error());
        }
        costs.emplace_back(fov, prediction->layer_pixels);
    }
    double mean_fov = 0.0;
    double mean_cost = 0.0;
    for (const auto& [fov, cost] : costs) {
        mean_fov += fov / kPoints;
        mean_cost += cost / kPoints;
    }
    double covariance = 0.0;
    double variance = 0.0;
    for (const auto& [fov, cost] : costs) {
        covariance += (fov - mean_fov) * (cost - mean_cost);
        variance += (fov - mean_fov) * (fov - mean_fov);
    }
    CostGrowth growth{.slope_per_deg = covariance / variance};
    for (const auto& [fov, cost] : costs) {
        const double line_cost = mean_cost + growth.slope_per_deg * (fov - mean_fov);
        growth.worst_deviation =
            std::max(growth.worst_deviation, std::abs(cost - line_cost) / costs.back().second);
    }
    const auto& [fov_before, cost_before] = costs[kPoints - 2];
    growth.end_exponent =
        std::log(costs.back().second / cost_before) / std::log(costs.back().first / fov_before);
    return growth;
}

}  // namespace gazeloop::foveation
