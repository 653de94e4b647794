#include "runtime/foveation/eye/acuity_model.h"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace gazeloop::foveation {

double nasal_share(gaze::Eye eye, double direction_rad) {
    const double nasal_rad = eye == gaze::Eye::Left ? 0.0 : std::numbers::pi;
    const double off = std::abs(std::remainder(direction_rad - nasal_rad, 2.0 * std::numbers::pi));
    return std::max(0.0, 1.0 - off / (std::numbers::pi / 2.0));
}

}  // namespace gazeloop::foveation
