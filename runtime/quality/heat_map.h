#pragma once

#include "runtime/quality/plane.h"
#include "runtime/render/host_picture.h"

namespace gazeloop::quality {

/// A map as colours: black at 0, then violet, red, orange and white at `most` and above, along
/// log(1 + 15 value / most), so that small values show. Precondition: most > 0.
[[nodiscard]] render::Picture heat_map(const Plane& map, double most);

/// Where maps of the foveated contrast metric are white, thresholds; FLIP's at 1.
inline constexpr double kContrastMapMost = 15.0;

}  // namespace gazeloop::quality
