#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <utility>
#include <vector>

#include "runtime/error.h"
#include "runtime/foveation/eye/acuity_model.h"
#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/foveation/picture/image_size.h"
#include "runtime/foveation/picture/offered_density.h"
#include "runtime/foveation/plans/method_plan.h"
#include "runtime/foveation/plans/prepared_views.h"

namespace gazeloop::foveation {

/// Foveation by variable-rate shading: one sample per pixel near the gaze, then one per 2 x 2 and
/// one per 4 x 4 pixels further out. The rate is chosen tile by tile.
struct RingParameters {
    static constexpr std::uint32_t kMinTilePx = 4;
    static constexpr std::uint32_t kMaxTilePx = 64;

    double inner_deg = 0.0;      ///< one sample per pixel within this; [0, 180]
    double outer_deg = 0.0;      ///< one per 2 x 2 from there to this; [inner_deg, 180]
    std::uint32_t tile_px = 16;  ///< side of a tile; a multiple of 4 in [kMinTilePx, kMaxTilePx]
};

/// The narrowest rings that satisfy a model wherever the gaze is. Pixels of the picture are
/// coarsest on its axis, and all are taken to be as coarse. `nasal` as for AcuityModel. For a model
/// that knows directions, use 1: then the rings suffice on both sides.
[[nodiscard]] RingParameters sufficient_rings(const gaze::EyeView& view, const AcuityModel& model,
                                              double nasal, std::uint32_t tile_px);

/// Pixels of a row of tiles that get the two finer rates: whole tiles, cut by the picture. The
/// inner ones lie among the outer ones.
struct RingRow {
    Columns inner;  ///< one sample per pixel
    Columns outer;  ///< at least one sample per 2 x 2 pixels
};

/// The rates of one picture at one gaze.
struct RingRates {
    ImageSize image;
    std::uint32_t tile_px = 0;
    std::vector<RingRow> rows;  ///< of tiles
    /// Samples by log2 of their rate, including those whose pixels lie partly outside the picture.
    std::array<std::uint64_t, 3> samples_at{};

    [[nodiscard]] std::uint64_t samples() const {
        return samples_at[0] + samples_at[1] + samples_at[2];
    }
    /// log2 of the rate of a pixel: 0, 1 or 2. Precondition: it lies in the picture.
    [[nodiscard]] unsigned log2_rate(std::uint32_t x_px, std::uint32_t y_px) const;
};

/// A tile takes the rate of its point nearest to the gaze, so no pixel gets less than its
/// eccentricity asks for. Where a row of tiles leaves a rate and comes back to it (beyond 90
/// degrees), what lies between has it too. Errors (Usage): a parameter out of range or not a
/// number.
Expected<RingRates> plan_rings(const GazeField& field, const RingParameters& parameters);

class RingDensity final : public OfferedDensity {
  public:
    explicit RingDensity(RingRates rates) : rates_(std::move(rates)) {}

    [[nodiscard]] SampleGrid at(const FieldPoint& at) const override;

  private:
    RingRates rates_;
};

/// Rings for every frame. Its grids are the pixels and the blocks of 2 x 2 and of 4 x 4 pixels:
/// "rate_1", "rate_2" and "rate_4". EyePlan::table has three pairs per kBandRows rows of the
/// picture: pixels [first, end) of the inner rate, of the outer rate, and of what is visible.
class RingsPlan final : public MethodPlan {
  public:
    /// The rings for a view. Errors (Usage).
    using RingsOf = std::function<Expected<RingParameters>(const gaze::EyeView&)>;
    explicit RingsPlan(RingsOf rings_of) : rings_of_(std::move(rings_of)) {}

    /// Words of the table of a picture this high.
    [[nodiscard]] static std::size_t table_words(std::uint32_t height_px);

    [[nodiscard]] const frame::GridList& grids() const override;
    [[nodiscard]] bool fits(const gaze::StereoView& views) const override;
    Expected<void> prepare(const gaze::StereoView& views) override;
    void plan(gaze::Eye eye, const gaze::EyeView& view, const gaze::FoveaPoint& fovea,
              const HiddenArea* hidden, const FrameInRun& frame, EyePlan& plan) const override;

  private:
    RingsOf rings_of_;
    gaze::PerEye<RingParameters> rings_{};
    PreparedViews prepared_;
};

}  // namespace gazeloop::foveation
