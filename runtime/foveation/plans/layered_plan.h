#pragma once

#include <cstddef>
#include <functional>
#include <vector>

#include "runtime/foveation/plans/layer_plan.h"
#include "runtime/foveation/plans/method_plan.h"
#include "runtime/foveation/plans/prepared_views.h"

namespace gazeloop::foveation {

struct LayeredOptions {
    /// Most layers, 1 to LayeredPlan::kMostLayers; a view may need fewer.
    std::size_t layers = 3;
    /// Layers but the inner one are shaded in every second frame, in turns, and kept in between.
    bool half_rate = false;
    /// What one frame shades is of use to the next: nothing is left out because it is hidden, since
    /// the next frame may show it.
    bool kept = false;
};

/// Layers around the gaze for every frame: each a grid, "layer_1" (the inner one) and on. The last
/// one that a view has is the whole picture.
///
/// EyePlan::uniforms holds a Layer for each, then the gaze in the view's frame. EyePlan::table
/// holds the columns [first, end) of each kBandRows rows of cells, layer after layer. A layer whose
/// turn it is not plans no cells.
class LayeredPlan final : public MethodPlan {
  public:
    static constexpr std::size_t kMostLayers = 4;

    /// As shaders take it; std140.
    struct Layer {
        glm::vec4 covers{0.0F};  ///< x0, y0, width, height, px of the picture
        /// Width, height in cells; bands of the table before its own; 1: it is this layer's turn.
        glm::vec4 cells{0.0F};
        /// How much is shown of it, 1 and more: all, 0 and less: nothing. By sin(e / 2): where it
        /// is 0, and how much per unit inside. By pixels from its edges: how much per px, x and y.
        glm::vec4 blend{0.0F};
    };

    /// A view's layers, inner first. Errors (Usage).
    using LayersOf = std::function<Expected<std::vector<LayerShape>>(const gaze::EyeView&)>;
    LayeredPlan(const LayeredOptions& options, LayersOf layers_of);

    [[nodiscard]] const frame::GridList& grids() const override { return grids_; }
    [[nodiscard]] bool fits(const gaze::StereoView& views) const override;
    Expected<void> prepare(const gaze::StereoView& views) override;
    void plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
              const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const override;

    /// Precondition: prepare().
    [[nodiscard]] const std::vector<LayerShape>& layers(gaze::Eye eye) const {
        return layers_[gaze::index(eye)];
    }
    /// Words of the table of a picture this high.
    [[nodiscard]] std::size_t table_words(std::uint32_t height_px) const;

    [[nodiscard]] static Layer layer_of(const EyePlan& plan, std::size_t layer);
    [[nodiscard]] static glm::vec3 gaze_of(const EyePlan& plan) {
        return glm::vec3(plan.uniforms[3 * kMostLayers]);
    }

  private:
    [[nodiscard]] Layer plan_shown(const GazeField& field, std::size_t layer,
                                   const LayerShape& shape, const HiddenArea* hidden, bool its_turn,
                                   EyePlan& plan) const;

    LayeredOptions options_;
    LayersOf layers_of_;
    frame::GridList grids_;
    gaze::PerEye<std::vector<LayerShape>> layers_;
    PreparedViews prepared_;
};

}  // namespace gazeloop::foveation
