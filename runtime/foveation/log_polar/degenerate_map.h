#pragma once

#include <string>

#include "runtime/foveation/log_polar/log_polar_map.h"

namespace gazeloop::foveation {

/// Why a map is too coarse to show a picture, however exact it is. Either its first column outside
/// `core_px` reaches more than 32 px from the fovea. Or its last column is wider than both 32 px
/// and a quarter of the farthest radius. Empty if neither.
[[nodiscard]] std::string why_degenerate(const LogPolarMap& map, LpSize lp, double core_px);

}  // namespace gazeloop::foveation
