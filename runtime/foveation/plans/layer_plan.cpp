#include "runtime/foveation/plans/layer_plan.h"

#include <cmath>

namespace gazeloop::foveation {

std::uint64_t LayerPlan::samples() const {
    std::uint64_t sum = 0;
    for (const PlannedLayer& layer : layers) {
        sum += std::uint64_t{layer.width} * layer.height;
    }
    return sum;
}

double LayerPlan::weighted_samples() const {
    double sum = 0.0;
    for (const PlannedLayer& layer : layers) {
        sum += layer.weight * static_cast<double>(std::uint64_t{layer.width} * layer.height);
    }
    return sum;
}

LayerDisplay layer_display(const gaze::EyeView& view) {
    const double width_tangent = std::tan(view.fov.right_rad) - std::tan(view.fov.left_rad);
    const double height_tangent = std::tan(view.fov.up_rad) - std::tan(view.fov.down_rad);
    const double width = view.width_px;
    const double height = view.height_px;
    if (width / width_tangent <= height / height_tangent) {
        return {width_tangent / 2.0, width, height / width};
    }
    return {height_tangent / 2.0, height, width / height};
}

Expected<LayerPlan> plan_layers(const GazeField& field, const MarLine& line,
                                const LayerOptions& options) {
    const gaze::EyeView& view = field.view();
    const auto optimised = optimise_layers(layer_display(view), line, options);
    if (!optimised) {
        return std::unexpected(optimised.error());
    }
    LayerPlan plan;
    for (std::size_t i = 0; i < optimised->layers.size(); ++i) {
        const EccentricityLayer& layer = optimised->layers[i];
        const bool last = i + 1 == optimised->layers.size();
        const double radius_deg = last ? 180.0 : layer.radius_deg;
        const Tile covers = field.pixels_within(radius_deg);
        const auto samples = [&](std::uint32_t pixels) {
            return static_cast<std::uint32_t>(std::ceil(pixels / layer.factor - 1e-9));
        };
        plan.layers.push_back({.radius_deg = radius_deg,
                               .factor = layer.factor,
                               .covers = covers,
                               .width = samples(covers.x1 - covers.x0),
                               .height = samples(covers.y1 - covers.y0),
                               .weight = layer.weight});
    }
    return plan;
}

SampleGrid LayerDensity::at(const FieldPoint& at) const {
    std::size_t layer = 0;
    while (layer + 1 < plan_.layers.size() &&
           at.eccentricity_deg > plan_.layers[layer].radius_deg) {
        ++layer;
    }
    return SampleGrid::square(1.0 / plan_.layers[layer].factor).in_degrees(at);
}

}  // namespace gazeloop::foveation
