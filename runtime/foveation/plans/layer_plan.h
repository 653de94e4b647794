#pragma once

#include <cstdint>
#include <utility>
#include <vector>

#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/foveation/picture/offered_density.h"
#include "runtime/foveation/picture/tile.h"
#include "runtime/foveation/plans/eccentricity_layers.h"

namespace gazeloop::foveation {

/// One layer of an eye's picture: what is rendered, and how finely.
struct PlannedLayer {
    double radius_deg = 0.0;  ///< shown up to this eccentricity; 180 for the last layer
    double factor = 1.0;      ///< picture pixels per sample, each way
    Tile covers;              ///< pixels of the picture
    std::uint32_t width = 0;  ///< samples
    std::uint32_t height = 0;
    double weight = 1.0;  ///< work of a sample: .5 for a layer at half rate
};

/// What decides a layer, whatever the gaze.
struct LayerShape {
    double radius_deg = 180.0;  ///< shown up to this eccentricity; 180: everywhere
    /// Of the picture's sides, for a rectangle around the gaze that is pushed back into the
    /// picture; 1: everywhere.
    double share = 1.0;
    double factor = 1.0;  ///< picture pixels per sample, each way
    double weight = 1.0;  ///< work of a sample

    /// How much of its radius, or of the rectangle's sides, the blend with the next layer takes.
    double blend = 0.0;
};

/// A layer at one gaze: the rectangle around its cone, cut by the picture, or its own rectangle.
[[nodiscard]] PlannedLayer plan_layer(const GazeField& field, const LayerShape& shape);

/// The published blend: a smoothstep over the outer 40 % of a layer's radius.
inline constexpr double kPublishedBlend = 0.4;

/// The layers that the optimiser finds for a gaze at the picture's centre, inner first. Pixels are
/// coarsest there, so the layers are more than enough elsewhere. Errors: as optimise_layers.
Expected<std::vector<LayerShape>> optimised_layers(const gaze::EyeView& view, const MarLine& line,
                                                   const LayerOptions& options);

/// Eccentricity layers of one picture at one gaze. Each layer is the rectangle around its cone of
/// eccentricity, cut by the picture; the last one is the whole picture. A layer wholly outside the
/// picture has no samples.
struct LayerPlan {
    std::vector<PlannedLayer> layers;  ///< inner first

    /// Samples if every layer is rendered for every frame.
    [[nodiscard]] std::uint64_t samples() const;
    /// The same, each layer's samples times its weight.
    [[nodiscard]] double weighted_samples() const;
};

/// The display as the optimiser sees it: by the axis with the coarser pixels. So its sharpness
/// angle holds for both axes.
[[nodiscard]] LayerDisplay layer_display(const gaze::EyeView& view);

/// The optimised layers at one gaze. Eccentricity is the true angle, also off axis, where the
/// published circle in pixels is too small. Errors: as optimise_layers.
Expected<LayerPlan> plan_layers(const GazeField& field, const MarLine& line,
                                const LayerOptions& options);

/// What the layers offer: each one's grid up to its radius. The published blend mixes the next
/// coarser layer in over the outer 40 % of a layer's radius; it is not counted here.
class LayerDensity final : public OfferedDensity {
  public:
    explicit LayerDensity(LayerPlan plan) : plan_(std::move(plan)) {}

    [[nodiscard]] SampleGrid at(const FieldPoint& at) const override;

  private:
    LayerPlan plan_;
};

}  // namespace gazeloop::foveation
