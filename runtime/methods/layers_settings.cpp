#include "runtime/methods/layers_settings.h"

#include "runtime/methods/only_under.h"

namespace gazeloop::methods {

std::vector<settings::SettingRow> rows_of(LayersSettings& layers) {
    using settings::Concerns;
    const settings::OnlyWhile only = only_under({"layers"});
    return {
        {"layers.half_rate",
         "shade the outer layers in every second frame, in turns, and reproject them in between",
         &layers.half_rate, Concerns::Picture, only},
        {"layers.n", "greatest number of eccentricity layers", settings::Whole{&layers.n, 2, 4},
         Concerns::Picture, only},
        {"layers.outer_weight",
         "work per sample of the outer layers, for the optimiser; half rate comes on top",
         settings::Number{&layers.outer_weight, 0.05, 1.0}, Concerns::Picture, only},
        {"layers.s2_fixed", "middle layer at 2x2 pixels per sample, as published (layers.n 3 or 4)",
         &layers.s2_fixed, Concerns::Picture, only},
        {"layers.temporal",
         "antialiasing over frames: samples move in their cells, last frames are reprojected",
         &layers.temporal, Concerns::Picture, only},
    };
}

foveation::LayerOptions parameters(const LayersSettings& layers) {
    foveation::LayerOptions options{.layers = static_cast<int>(layers.n), .weights = {1.0}};
    options.weights.resize(static_cast<std::size_t>(layers.n),
                           layers.outer_weight * (layers.half_rate ? 0.5 : 1.0));
    options.second_factor = layers.s2_fixed ? 2.0 : 0.0;
    return options;
}

}  // namespace gazeloop::methods
