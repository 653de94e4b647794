#pragma once

#include <algorithm>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <glm/gtc/packing.hpp>
#include <numbers>

#include "runtime/gaze/seen_depth.h"

namespace gazeloop::gaze {

/// 1 / distance along a ray from a place, unit vector; what a scene is to a test.
using Scene = std::function<double(const glm::dvec3& from_m, const glm::dvec3& towards)>;

inline constexpr double kHalfBetweenEyes_m = 0.0315;

/// What both eyes of a head at `head` see of a scene: the whole picture of 80 x 70 degrees, every
/// quarter of a degree a sample.
inline SeenDepth painted(const Scene& scene, const Pose& head = {}) {
    SeenDepth seen;
    for (const Eye eye : kEyes) {
        DepthPatch& patch = seen[index(eye)];
        const double aside_m = eye == Eye::Left ? -kHalfBetweenEyes_m : kHalfBetweenEyes_m;
        patch.view = {.pose = compose(head, {.position_m = {aside_m, 0.0, 0.0}}),
                      .fov = {-0.7, 0.7, 0.6, -0.6},
                      .width_px = 770,
                      .height_px = 630};
        patch.step_x_px = 2;
        patch.step_y_px = 2;
        patch.columns = 385;
        patch.rows = 315;
        for (std::uint32_t row = 0; row < patch.rows; ++row) {
            for (std::uint32_t column = 0; column < patch.columns; ++column) {
                const glm::dvec3 ray = unproject({column * 2.0 + 0.5, row * 2.0 + 0.5}, patch.view);
                const double nearness =
                    scene(patch.view.pose.position_m, patch.view.pose.orientation * ray);
                patch.nearness.push_back(glm::packHalf1x16(static_cast<float>(nearness)));
            }
        }
    }
    return seen;
}

/// A wall across the way, `z_m` ahead of the world's origin, from `left_m` to `right_m`.
inline Scene wall(double z_m, double left_m, double right_m) {
    return [=](const glm::dvec3& from_m, const glm::dvec3& towards) {
        const double t_m = (-z_m - from_m.z) / towards.z;
        const double x_m = from_m.x + t_m * towards.x;
        return t_m > 0.0 && x_m >= left_m && x_m <= right_m ? 1.0 / t_m : 0.0;
    };
}

/// What is nearer hides what is behind.
inline Scene both(const Scene& a, const Scene& b) {
    return [=](const glm::dvec3& from_m, const glm::dvec3& towards) {
        return std::max(a(from_m, towards), b(from_m, towards));
    };
}

/// A unit vector so many degrees to the right and up of straight ahead.
inline glm::dvec3 towards_deg(double right_deg, double up_deg) {
    constexpr double kRadians = std::numbers::pi / 180.0;
    const double azimuth = right_deg * kRadians;
    const double elevation = up_deg * kRadians;
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            -std::cos(azimuth) * std::cos(elevation)};
}

}  // namespace gazeloop::gaze
