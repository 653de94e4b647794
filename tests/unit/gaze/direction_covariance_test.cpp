#include "runtime/gaze/direction_covariance.h"

#include <gtest/gtest.h>

#include <cmath>

namespace gazeloop::gaze {
namespace {

TEST(DirectionCovariance, HasAxesThatStandUprightAndToTheRight) {
    const ErrorAxes ahead = error_axes(kStraightAhead);
    EXPECT_EQ(ahead.across, (glm::dvec3{1.0, 0.0, 0.0}));
    EXPECT_EQ(ahead.up, (glm::dvec3{0.0, 1.0, 0.0}));
    // To the right and up: across stays level, up leans back.
    const glm::dvec3 direction = glm::normalize(glm::dvec3{0.6, 0.5, -0.8});
    const auto [across, up] = error_axes(direction);
    EXPECT_EQ(across.y, 0.0);
    EXPECT_NEAR(across.x, 0.8, 1e-15);
    EXPECT_NEAR(across.z, 0.6, 1e-15);
    EXPECT_GT(up.y, 0.0);
    for (const double dot :
         {glm::dot(across, direction), glm::dot(up, direction), glm::dot(across, up)}) {
        EXPECT_NEAR(dot, 0.0, 1e-15);
    }
    EXPECT_NEAR(glm::length(up), 1.0, 1e-15);
    const ErrorAxes straight_up = error_axes({0.0, 1.0, 0.0});
    EXPECT_EQ(straight_up.across, (glm::dvec3{1.0, 0.0, 0.0}));
    EXPECT_NEAR(glm::length(straight_up.up), 1.0, 1e-15);
}

TEST(DirectionCovariance, TakesWhatTurnsTheDirection) {
    EXPECT_EQ(turning_part(kStraightAhead, {4.0, 9.0, 100.0}),
              (DirectionCovariance{4.0, 0.0, 9.0}));
    // Alike on all axes it is the same whichever way the eye looks.
    for (const glm::dvec3& d : {glm::dvec3{1.0, 0.0, 0.0}, glm::normalize(glm::dvec3{1, 2, -3})}) {
        const DirectionCovariance same = turning_part(d, glm::dvec3{2.0});
        EXPECT_NEAR(same.xx_rad2, 2.0, 1e-14);
        EXPECT_NEAR(same.xy_rad2, 0.0, 1e-14);
        EXPECT_NEAR(same.yy_rad2, 2.0, 1e-14);
    }
}

TEST(DirectionCovariance, IsGreatestAlongItsMainAxis) {
    EXPECT_DOUBLE_EQ(greatest_sd_rad({4.0, 0.0, 9.0}), 3.0);
    // Eigenvalues of (2, 1; 1, 2) are 1 and 3.
    EXPECT_DOUBLE_EQ(greatest_sd_rad({2.0, 1.0, 2.0}), std::sqrt(3.0));
    EXPECT_EQ(greatest_sd_rad({}), 0.0);
}

}  // namespace
}  // namespace gazeloop::gaze
