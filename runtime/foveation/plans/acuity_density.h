#pragma once

#include <algorithm>

#include "runtime/foveation/log_polar/acuity_map.h"
#include "runtime/foveation/picture/offered_density.h"

namespace gazeloop::foveation {

/// What the acuity-derived map offers: pixels in the disc's unblended core, texels of the LP-buffer
/// outside it. It is the same all around at one eccentricity.
class AcuityDensity final : public OfferedDensity {
  public:
    /// `core_deg`: eccentricity inside which only pixels are shown; 0: no disc.
    AcuityDensity(const AcuityMap& map, double core_deg) : map_(map), core_deg_(core_deg) {}

    [[nodiscard]] SampleGrid at(const FieldPoint& at) const override {
        if (at.eccentricity_deg < core_deg_) {
            return SampleGrid::square(1.0).in_degrees(at);
        }
        // The density has a limit at the gaze itself, but no formula.
        constexpr double kLeastEccentricityDeg = 1e-6;
        const Density density = map_.density_at(
            std::max(at.eccentricity_deg, kLeastEccentricityDeg), map_.profile().lp());
        return {{density.radial, 0.0}, {0.0, density.tangential}};
    }

  private:
    AcuityMap map_;
    double core_deg_;
};

}  // namespace gazeloop::foveation
