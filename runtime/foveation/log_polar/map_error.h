#pragma once

#include <vector>

#include "runtime/foveation/log_polar/acuity_map.h"
#include "runtime/foveation/log_polar/log_polar_map.h"

namespace gazeloop::foveation {

/// What float arithmetic and tables may cost, in pixels of the picture: bounds derived in
/// map_error.cpp, from the operations as they stand in the shaders, with the rounding that Vulkan
/// allows them. They hold where a position has consequences: between the centres of the first and
/// the last column, beyond which the sampler clamps.
class MapError {
  public:
    /// Of every map with this kernel, or this profile.
    explicit MapError(const RadialKernel& kernel);
    explicit MapError(const AcuityProfile& profile);

    /// Of the position that the float shares of a picture's position stand for.
    [[nodiscard]] double forward_px(const LogPolarMap& map,
                                    const gaze::PixelPosition& position) const;
    [[nodiscard]] double forward_px(const AcuityMap& map,
                                    const gaze::PixelPosition& position) const;

    /// What no arithmetic could beat that hands on u and v as floats: half a unit in the last place
    /// of each.
    [[nodiscard]] static double conditioning_px(const RadialMap& map,
                                                const gaze::PixelPosition& position);

    /// Of the position computed for a texel's centre.
    [[nodiscard]] static double inverse_px(const LogPolarMap& map, const LpShare& centre);
    [[nodiscard]] static double inverse_px(const AcuityMap& map, const LpShare& centre);

  private:
    [[nodiscard]] double table_error(double s) const;

    std::vector<double> cell_errors_;  ///< of u, by linear interpolation in the forward table
};

}  // namespace gazeloop::foveation
