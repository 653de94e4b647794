#pragma once

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/gaze/pose.h"

namespace gazeloop::gaze {

// What no head does. Heads that follow targets in a headset turn at up to 150 deg/s; the fastest
// turns that people can make stay below 1000 deg/s, and a head that is thrust forward, below 3 m/s.
inline constexpr double kFastestTurn_rad_s = 26.18;  ///< 1500 deg/s
inline constexpr double kFastestMove_m_s = 5.0;

/// The angle of the turn between two poses, 0 .. pi.
[[nodiscard]] inline double turned_rad(const Pose& from, const Pose& to) {
    const glm::dquat turn = glm::conjugate(from.orientation) * to.orientation;
    return 2.0 * std::atan2(glm::length(glm::dvec3{turn.x, turn.y, turn.z}), std::abs(turn.w));
}

[[nodiscard]] inline double moved_m(const Pose& from, const Pose& to) {
    return glm::length(to.position_m - from.position_m);
}

/// The time that a head needs at least to get from one pose to the other, seconds. A pose change
/// in less is none of the head: the origin that poses are given in has moved. Precondition: both
/// are usable (usable_pose.h).
[[nodiscard]] inline double least_time_s(const Pose& from, const Pose& to) {
    return std::max(turned_rad(from, to) / kFastestTurn_rad_s,
                    moved_m(from, to) / kFastestMove_m_s);
}

}  // namespace gazeloop::gaze
