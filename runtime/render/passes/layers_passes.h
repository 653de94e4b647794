#pragma once

#include <memory>

#include "runtime/foveation/plans/layered_plan.h"
#include "runtime/render/passes/method_passes.h"

namespace gazeloop::render {

struct LayersConfig {
    std::size_t layers = 3;  ///< most, 1 to LayeredPlan::kMostLayers
    /// Layers but the inner one are shaded in every second frame, in turns, and reprojected in
    /// between.
    bool half_rate = false;
    /// Antialiasing over frames: samples move in their cells, and what the last frames left is
    /// reprojected and mixed in.
    bool over_frames = false;
};

/// Layers around the gaze, each at a resolution of its own: a pass for each layer, "layer_1" the
/// inner one, and "composite". Its prepare() throws SetupError (Usage) as `layers_of` reports.
[[nodiscard]] std::unique_ptr<MethodPasses> make_layers_passes(
    const PassSetup& setup, const LayersConfig& config, foveation::LayeredPlan::LayersOf layers_of);

}  // namespace gazeloop::render
