#pragma once

#include <memory>

#include "runtime/foveation/plans/cell_turns.h"
#include "runtime/foveation/plans/log_polar_method_plan.h"

namespace gazeloop::foveation {

/// A log-polar method whose texels, and the pixels of its disc, take turns: each frame shades one
/// cell of every block, and keeps what earlier frames showed of the others. Its grids are those of
/// the method, in cells.
class InterleavedPlan final : public MethodPlan {
  public:
    InterleavedPlan(std::unique_ptr<LogPolarMethodPlan> whole, CellTurns texels, CellTurns pixels)
        : whole_(std::move(whole)), texels_(texels), pixels_(pixels) {}

    [[nodiscard]] const frame::GridList& grids() const override { return whole_->grids(); }
    [[nodiscard]] bool fits(const gaze::StereoView& views) const override {
        return whole_->fits(views);
    }
    Expected<void> prepare(const gaze::StereoView& views) override {
        return whole_->prepare(views);
    }
    /// EyePlan::table has the bands that the picture reads: of the LP-buffer's texels, then of the
    /// picture's pixels, as first and end of their columns.
    void plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
              const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const override;

    /// The method whose texels take turns.
    [[nodiscard]] const LogPolarMethodPlan& whole() const { return *whole_; }
    [[nodiscard]] const CellTurns& texels() const { return texels_; }
    [[nodiscard]] const CellTurns& pixels() const { return pixels_; }

    /// Bands of a side of so many rows.
    [[nodiscard]] static std::uint32_t bands(std::uint32_t rows) {
        return (rows + kBandRows - 1) / kBandRows;
    }

  private:
    std::unique_ptr<LogPolarMethodPlan> whole_;
    CellTurns texels_;
    CellTurns pixels_;
};

}  // namespace gazeloop::foveation
