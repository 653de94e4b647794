#include "runtime/foveation/plans/layer_plan.h"

#include <algorithm>
#include <cmath>
#include <utility>

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

PlannedLayer plan_layer(const GazeField& field, const LayerShape& shape) {
    const gaze::EyeView& view = field.view();
    Tile covers = field.pixels_within(shape.radius_deg);
    if (shape.share < 1.0) {
        const gaze::PixelPosition fovea = field.fovea();
        const auto side = [&](double centre_px, std::uint32_t size) {
            const double wide = std::max(1.0, std::round(shape.share * size));
            const double first = std::round(centre_px - 0.5 * wide);
            return std::pair{static_cast<std::uint32_t>(std::clamp(first, 0.0, size - wide)),
                             static_cast<std::uint32_t>(wide)};
        };
        const auto [x0, width] = side(fovea.x_px, view.width_px);
        const auto [y0, height] = side(fovea.y_px, view.height_px);
        covers = {x0, y0, x0 + width, y0 + height};
    }
    const auto samples = [&](std::uint32_t pixels) {
        return static_cast<std::uint32_t>(std::ceil(pixels / shape.factor - 1e-9));
    };
    return {.radius_deg = shape.radius_deg,
            .factor = shape.factor,
            .covers = covers,
            .width = samples(covers.x1 - covers.x0),
            .height = samples(covers.y1 - covers.y0),
            .weight = shape.weight};
}

Expected<std::vector<LayerShape>> optimised_layers(const gaze::EyeView& view, const MarLine& line,
                                                   const LayerOptions& options) {
    const auto optimised = optimise_layers(layer_display(view), line, options);
    if (!optimised) {
        return std::unexpected(optimised.error());
    }
    std::vector<LayerShape> shapes;
    for (std::size_t i = 0; i < optimised->layers.size(); ++i) {
        const EccentricityLayer& layer = optimised->layers[i];
        const bool last = i + 1 == optimised->layers.size();
        shapes.push_back({.radius_deg = last ? 180.0 : layer.radius_deg,
                          .factor = layer.factor,
                          .weight = layer.weight,
                          .blend = kPublishedBlend});
    }
    return shapes;
}

Expected<LayerPlan> plan_layers(const GazeField& field, const MarLine& line,
                                const LayerOptions& options) {
    const auto shapes = optimised_layers(field.view(), line, options);
    if (!shapes) {
        return std::unexpected(shapes.error());
    }
    LayerPlan plan;
    for (const LayerShape& shape : *shapes) {
        plan.layers.push_back(plan_layer(field, shape));
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
