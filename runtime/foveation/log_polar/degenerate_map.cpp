#include "runtime/foveation/log_polar/degenerate_map.h"

#include <fmt/core.h>

namespace gazeloop::foveation {
namespace {

constexpr double kWidestPx = 32.0;
constexpr double kWidestLastShare = 0.25;

}  // namespace

std::string why_degenerate(const LogPolarMap& map, LpSize lp, double core_px) {
    const double first = map.radius_px(1.0 / lp.width);
    const double last = map.max_radius_px() - map.radius_px(1.0 - 1.0 / lp.width);
    if (first > kWidestPx && first > core_px) {
        return fmt::format("the first column reaches {:.0f} px from the fovea", first);
    }
    if (last > kWidestPx && last > kWidestLastShare * map.max_radius_px()) {
        return fmt::format("the last column is {:.0f} px wide", last);
    }
    return "";
}

}  // namespace gazeloop::foveation
