#pragma once

#include "runtime/gaze/pose.h"

namespace gazeloop::render {

/// From where and when a frame shows the scene.
struct CutPlace {
    gaze::Pose pose{};
    double scene_time_s = 0.0;
};

inline constexpr double kCutStep_m = 0.5;
inline constexpr double kCutTurn_rad = 0.7;
inline constexpr double kCutTime_s = 2.0;

/// Whether nothing of the last frame can be of use: the eye moved over kCutStep_m or turned over
/// kCutTurn_rad, or scene time went on or back by over kCutTime_s.
[[nodiscard]] bool is_cut(const CutPlace& before, const CutPlace& now);

}  // namespace gazeloop::render
