#pragma once

#include "runtime/foveation/log_polar/log_polar_map.h"
#include "runtime/foveation/picture/offered_density.h"

namespace gazeloop::foveation {

/// What kernel foveated rendering offers: pixels in the disc's unblended core, texels of the
/// LP-buffer outside it. The map is in pixels around the fovea. So at an off-axis gaze, its density
/// at one eccentricity differs by direction.
class KfrDensity final : public OfferedDensity {
  public:
    /// `core_px`: radius inside which only pixels are shown; 0: no disc.
    KfrDensity(const LogPolarMap& map, LpSize lp, const gaze::PixelPosition& fovea, double core_px);

    [[nodiscard]] SampleGrid at(const FieldPoint& at) const override;

  private:
    LogPolarMap map_;
    LpSize lp_;
    gaze::PixelPosition fovea_;
    double core_px_;
};

}  // namespace gazeloop::foveation
