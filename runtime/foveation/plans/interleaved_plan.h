#pragma once

#include <memory>
#include <span>

#include "runtime/foveation/plans/cell_turns.h"
#include "runtime/foveation/plans/kfr_plan.h"

namespace gazeloop::foveation {

/// KFR whose texels, and the pixels of its disc, take turns: each frame shades one cell of every
/// block, and keeps what earlier frames showed of the others. Its grids are those of KFR, in cells.
///
/// Where nothing is kept that could be of use, all places of the blocks are shaded at once
/// (`refills`): everywhere in a frame with no frame before it; after the gaze has moved, the pixels
/// that were not in the disc, and the texels that were seen much more coarsely.
class InterleavedPlan final : public MethodPlan {
  public:
    InterleavedPlan(std::unique_ptr<KfrPlan> whole, CellTurns texels, CellTurns pixels,
                    bool refills = true)
        : whole_(std::move(whole)), texels_(texels), pixels_(pixels), refills_(refills) {}

    [[nodiscard]] const frame::GridList& grids() const override { return whole_->grids(); }
    [[nodiscard]] bool fits(const gaze::StereoView& views) const override {
        return whole_->fits(views);
    }
    Expected<void> prepare(const gaze::StereoView& views) override {
        return whole_->prepare(views);
    }
    /// EyePlan::table is Bands.
    void plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
              const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const override;

    /// The method whose texels take turns.
    [[nodiscard]] const KfrPlan& whole() const { return *whole_; }
    [[nodiscard]] const CellTurns& texels() const { return texels_; }
    [[nodiscard]] const CellTurns& pixels() const { return pixels_; }

    /// Bands of a side of so many rows.
    [[nodiscard]] static std::uint32_t bands(std::uint32_t rows) {
        return (rows + kBandRows - 1) / kBandRows;
    }

    /// What a plan's table has: first and end of the columns of each band
    struct Bands {
        std::span<const std::uint32_t> texels;  ///< of the LP-buffer, that the picture reads
        std::span<const std::uint32_t> pixels;  ///< of the picture, that it reads
        /// of their blocks, of which all places are shaded
        std::span<const std::uint32_t> texel_refill;
        std::span<const std::uint32_t> pixel_refill;
    };
    /// Of a plan for an eye's view of so many rows.
    [[nodiscard]] Bands bands_of(const EyePlan& plan, gaze::Eye eye, std::uint32_t rows) const;

  private:
    std::unique_ptr<KfrPlan> whole_;
    CellTurns texels_;
    CellTurns pixels_;
    bool refills_;
};

}  // namespace gazeloop::foveation
