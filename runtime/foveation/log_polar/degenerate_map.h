#pragma once

#include <string>

#include "runtime/foveation/log_polar/log_polar_map.h"

namespace gazeloop::foveation {

/// Why the parameters make a map of which no picture is worth drawing, however exact it is: its
/// first column, as far as `core_px` does not cover it, reaches more than 32 px from the fovea, or
/// its last one is wider than that and a quarter of the farthest radius. Empty: they do not.
[[nodiscard]] std::string why_degenerate(const LogPolarMap& map, LpSize lp, double core_px);

}  // namespace gazeloop::foveation
