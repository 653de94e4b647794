#pragma once

#include <cstdint>
#include <memory>
#include <span>
#include <vector>

#include "runtime/foveation/plans/method_plan.h"
#include "runtime/foveation/plans/nearest_samples.h"
#include "runtime/foveation/plans/prepared_views.h"
#include "runtime/foveation/plans/sparse_pattern.h"

namespace gazeloop::foveation {

struct SparseOptions {
    SparseParameters pattern;
    std::uint32_t neighbours = 4;  ///< k: samples that a pixel is filled from
    /// Whether the pattern is turned about the gaze from frame to frame: as it is, by half a turn,
    /// and mirrored either way. Other angles would take samples off the pixels.
    bool turn = false;
};

/// Sparse sampling for every frame. Its one grid, "samples", is a list: the samples that some
/// visible pixel may be filled from, row by row of the pattern. That is more than lie in the
/// picture, because pixels at its edge are filled from beyond it too.
///
/// EyePlan::table holds, as 32-bit integers, `kHeader` words and two for each row of the pattern
/// that is used, and for one beyond. The header:
///   samples in the list, rows, first row, origin x, origin y, sign x, sign y
/// with pixel p of the picture at origin + sign * p of the pattern. A row's words are the number of
/// samples in the rows before it, and the index in the pattern of its first.
class SparsePlan final : public MethodPlan {
  public:
    static constexpr std::uint32_t kListWidth = 512;  ///< cells in a row of the list's grid
    static constexpr std::size_t kHeader = 7;

    explicit SparsePlan(const SparseOptions& options) : options_(options) {}

    [[nodiscard]] const frame::GridList& grids() const override;
    [[nodiscard]] bool fits(const gaze::StereoView& views) const override;
    Expected<void> prepare(const gaze::StereoView& views) override;
    void plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
              const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const override;

    /// What no gaze changes. Eyes with pictures of one size share it.
    struct Prepared {
        SparsePattern pattern;
        NearestSamples nearest;
        std::vector<std::uint32_t> row_first;  ///< first sample of each row, and their number
        std::vector<std::uint16_t> reach_px;  ///< of each pixel: its farthest neighbour, rounded up

        [[nodiscard]] std::uint32_t list_rows() const {
            return static_cast<std::uint32_t>((pattern.samples.size() + kListWidth - 1) /
                                              kListWidth);
        }
        [[nodiscard]] std::size_t table_words() const {
            return kHeader + 2 * std::size_t{pattern.field().height_px} + 2;
        }
    };
    /// Precondition: prepare().
    [[nodiscard]] const std::shared_ptr<const Prepared>& prepared(gaze::Eye eye) const {
        return prepared_[gaze::index(eye)];
    }

  private:
    SparseOptions options_;
    gaze::PerEye<std::shared_ptr<const Prepared>> prepared_;
    PreparedViews views_;
};

}  // namespace gazeloop::foveation
