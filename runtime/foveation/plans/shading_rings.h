#pragma once

#include <array>
#include <cstdint>
#include <utility>
#include <vector>

#include "runtime/error.h"
#include "runtime/foveation/eye/acuity_model.h"
#include "runtime/foveation/picture/gaze_field.h"
#include "runtime/foveation/picture/offered_density.h"

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

/// The rates of one picture at one gaze.
struct RingPlan {
    std::uint32_t tile_px = 0;
    std::uint32_t columns = 0;
    std::uint32_t rows = 0;
    /// log2 of a tile's rate, row by row: 0, 1 or 2.
    std::vector<std::uint8_t> log2_rate;
    /// Samples by log2 of their rate, including those whose pixels lie partly outside the picture.
    std::array<std::uint64_t, 3> samples_at{};

    [[nodiscard]] std::uint64_t samples() const {
        return samples_at[0] + samples_at[1] + samples_at[2];
    }
};

/// A tile takes the rate of its point nearest to the gaze, so no pixel gets less than its
/// eccentricity asks for. Errors (Usage): a parameter out of range or not a number.
Expected<RingPlan> plan_rings(const GazeField& field, const RingParameters& parameters);

class RingDensity final : public OfferedDensity {
  public:
    explicit RingDensity(RingPlan plan) : plan_(std::move(plan)) {}

    [[nodiscard]] SampleGrid at(const FieldPoint& at) const override;

  private:
    RingPlan plan_;
};

}  // namespace gazeloop::foveation
