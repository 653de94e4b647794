#pragma once

#include <vector>

#include "runtime/foveation/log_polar/acuity_map.h"
#include "runtime/foveation/log_polar/log_polar_map.h"

namespace gazeloop::foveation {

/// Bounds on the error of float arithmetic and tables, in pixels of the picture. They are derived
/// in map_error.cpp from the shaders' operations as written, with the rounding that Vulkan allows.
/// They hold between the centres of the first and the last column; beyond these the sampler clamps,
/// so that an error there has no effect.
class MapError {
  public:
    /// Bounds for every map with this kernel, or this profile.
    explicit MapError(const RadialKernel& kernel);
    explicit MapError(const AcuityProfile& profile);

    /// Error of the position that the float shares (u, v) of a picture's position stand for.
    [[nodiscard]] double forward_px(const LogPolarMap& map,
                                    const gaze::PixelPosition& position) const;
    [[nodiscard]] double forward_px(const AcuityMap& map,
                                    const gaze::PixelPosition& position) const;

    /// The error that remains with perfect arithmetic. u and v are passed on as floats, so each is
    /// off by up to half a unit in the last place.
    [[nodiscard]] static double conditioning_px(const RadialMap& map,
                                                const gaze::PixelPosition& position);

    /// Error of the position computed for a texel's centre.
    [[nodiscard]] static double inverse_px(const LogPolarMap& map, const LpShare& centre);
    [[nodiscard]] static double inverse_px(const AcuityMap& map, const LpShare& centre);

  private:
    [[nodiscard]] double table_error(double s) const;

    std::vector<double> cell_errors_;  ///< of u, by linear interpolation in the forward table
};

}  // namespace gazeloop::foveation
