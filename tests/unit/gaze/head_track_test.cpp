#include "runtime/gaze/head_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <vector>

namespace gazeloop::gaze {
namespace {

Pose yawed(double yaw_deg, const glm::dvec3& position_m) {
    return {glm::angleAxis(glm::radians(yaw_deg), glm::dvec3{0.0, 1.0, 0.0}), position_m};
}

double yaw_deg(const Pose& pose) {
    const glm::dvec3 forward = pose.orientation * glm::dvec3{0.0, 0.0, -1.0};
    return glm::degrees(std::atan2(-forward.x, -forward.z));
}

TEST(HeadTrack, IsEmptyUntilAPoseIsAdded) {
    HeadTrack track;
    EXPECT_TRUE(track.empty());
    track.add(0, {});
    EXPECT_FALSE(track.empty());
}

TEST(HeadTrack, HoldsTheEndsOutside) {
    HeadTrack track;
    track.add(1000, yawed(10.0, {1.0, 0.0, 0.0}));
    track.add(2000, yawed(20.0, {2.0, 0.0, 0.0}));
    EXPECT_NEAR(yaw_deg(track.at(-5000)), 10.0, 1e-9);
    EXPECT_EQ(track.at(999).position_m.x, 1.0);
    EXPECT_NEAR(yaw_deg(track.at(9000)), 20.0, 1e-9);
    EXPECT_EQ(track.at(2001).position_m.x, 2.0);
}

TEST(HeadTrack, GivesTheRecordedPoseExactlyAtItsTime) {
    HeadTrack track;
    std::vector<Pose> poses;
    for (std::int64_t i = 0; i < 50; ++i) {
        const double x = static_cast<double>(i);
        poses.push_back(yawed(7.3 * x, {0.1 * x, 0.2, -0.3 * x}));
        track.add(7 * i, poses.back());
    }
    for (std::int64_t i = 0; i < 50; ++i) {
        const Pose& pose = poses[static_cast<std::size_t>(i)];
        EXPECT_EQ(track.at(7 * i).orientation, pose.orientation) << i;
        EXPECT_EQ(track.at(7 * i).position_m, pose.position_m) << i;
    }
}

TEST(HeadTrack, InterpolatesOnTheCircleBetween) {
    HeadTrack track;
    track.add(1000, yawed(-40.0, {0.0, 0.0, 0.0}));
    track.add(2000, yawed(80.0, {4.0, -2.0, 1.0}));
    const Pose quarter = track.at(1250);
    EXPECT_NEAR(yaw_deg(quarter), -10.0, 1e-9);
    EXPECT_NEAR(quarter.position_m.x, 1.0, 1e-12);
    EXPECT_NEAR(quarter.position_m.y, -0.5, 1e-12);
    EXPECT_NEAR(glm::length(quarter.orientation), 1.0, 1e-15);
}

TEST(HeadTrack, TurnsTheShorterWayRound) {
    HeadTrack track;
    track.add(0, yawed(170.0, {}));
    track.add(100, yawed(190.0, {}));
    EXPECT_NEAR(std::abs(yaw_deg(track.at(50))), 180.0, 1e-9);

    // The same orientation, written with the opposite sign.
    HeadTrack opposite;
    const Pose pose = yawed(30.0, {});
    opposite.add(0, pose);
    opposite.add(100, {-pose.orientation, {}});
    EXPECT_NEAR(yaw_deg(opposite.at(50)), 30.0, 1e-9);
}

TEST(HeadTrack, ReplacesAPoseAtTheSameTime) {
    HeadTrack track;
    track.add(0, yawed(0.0, {}));
    track.add(10, yawed(10.0, {}));
    track.add(10, yawed(50.0, {}));
    EXPECT_NEAR(yaw_deg(track.at(10)), 50.0, 1e-9);
    EXPECT_NEAR(yaw_deg(track.at(5)), 25.0, 1e-9);
}

TEST(HeadTrack, SpansAllTimes) {
    HeadTrack track;
    track.add(std::numeric_limits<std::int64_t>::min(), yawed(0.0, {0.0, 0.0, 0.0}));
    track.add(std::numeric_limits<std::int64_t>::max(), yawed(0.0, {2.0, 0.0, 0.0}));
    EXPECT_NEAR(track.at(0).position_m.x, 1.0, 1e-12);
}

}  // namespace
}  // namespace gazeloop::gaze
