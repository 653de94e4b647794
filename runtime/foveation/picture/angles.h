#pragma once

#include <numbers>

namespace gazeloop::foveation {

inline constexpr double kTurn = 2.0 * std::numbers::pi;  ///< radians
inline constexpr double kRadiansPerDegree = std::numbers::pi / 180.0;
inline constexpr double kDegreesPerRadian = 180.0 / std::numbers::pi;

}  // namespace gazeloop::foveation
