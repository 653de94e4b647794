#include "runtime/openxr_layer/placed_gaze.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>

namespace gazeloop::openxr_layer {
namespace {

glm::dvec3 any_vector(int size) {
    const auto number = rc::gen::inRange(-1000 * size, 1000 * size);
    return {*number * 1e-3, *number * 1e-3, *number * 1e-3};
}

gaze::Pose any_pose() {
    const glm::dvec3 turn = any_vector(3);
    const double angle = glm::length(turn);
    return {angle > 0.0 ? glm::angleAxis(angle, turn / angle) : glm::dquat(1.0, 0.0, 0.0, 0.0),
            any_vector(2)};
}

/// The pose after a short time of steady motion about its own place.
gaze::Pose later(const gaze::Pose& pose, const glm::dvec3& linear, const glm::dvec3& angular,
                 double seconds) {
    const double speed = glm::length(angular);
    const glm::dquat turned = speed > 0.0 ? glm::angleAxis(speed * seconds, angular / speed)
                                          : glm::dquat(1.0, 0.0, 0.0, 0.0);
    return {turned * pose.orientation, pose.position_m + seconds * linear};
}

/// Held against differences of poses: central, so that the error is of the third order in the step.
void expect_moves_like(const Moving& moving, const gaze::Pose& before, const gaze::Pose& after,
                       double step) {
    const glm::dvec3 linear = (after.position_m - before.position_m) / (2.0 * step);
    const glm::dquat turned = after.orientation * glm::conjugate(before.orientation);
    const double sign = turned.w < 0.0 ? -1.0 : 1.0;
    const glm::dvec3 angular = 2.0 * sign * glm::dvec3(turned.x, turned.y, turned.z) / (2.0 * step);
    RC_ASSERT(moving.linear && moving.angular);
    RC_ASSERT(glm::length(*moving.linear - linear) < 1e-5);
    RC_ASSERT(glm::length(*moving.angular - angular) < 1e-5);
}

RC_GTEST_PROP(PlacedGaze, MovesAsItsPosesDo, ()) {
    constexpr double kStep = 1e-5;
    const Moving head{.pose = any_pose(), .linear = any_vector(2), .angular = any_vector(3)};
    const GazeInHead gaze{.pose = any_pose(), .turning = any_vector(5)};
    const gaze::Pose fixed = any_pose();
    const auto at = [&](double seconds) {
        const Moving moved{.pose = later(head.pose, *head.linear, *head.angular, seconds),
                           .linear = head.linear,
                           .angular = head.angular};
        const GazeInHead turned{.pose = later(gaze.pose, glm::dvec3(0.0), *gaze.turning, seconds),
                                .turning = gaze.turning};
        return place_gaze(moved, turned, fixed);
    };
    expect_moves_like(at(0.0), at(-kStep).pose, at(kStep).pose, kStep);
    expect_moves_like(inverse(at(0.0)), inverse(at(-kStep)).pose, inverse(at(kStep)).pose, kStep);
}

TEST(PlacedGaze, SaysNothingOfUnknownMotion) {
    const Moving head{.pose = {}, .linear = {}, .angular = {}};
    EXPECT_FALSE(place_gaze(head, {}, {}).angular);
    const Moving turning{.pose = {}, .linear = {}, .angular = glm::dvec3(1.0, 0.0, 0.0)};
    const Moving placed = place_gaze(turning, {.pose = {}, .turning = glm::dvec3(0.0)}, {});
    EXPECT_TRUE(placed.angular);
    EXPECT_FALSE(placed.linear);
    EXPECT_FALSE(inverse(placed).linear);
}

}  // namespace
}  // namespace gazeloop::openxr_layer
