#include "runtime/gaze/combined_gaze.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>

#include "runtime/gaze/direction.h"
#include "tests/support/generated_numbers.h"

namespace gazeloop::gaze {
namespace {

using tests::between;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr PerEye<glm::dvec3> kEyes_m{glm::dvec3{-0.0315, 0.0, 0.0}, glm::dvec3{0.0315, 0.0, 0.0}};

double angle_rad(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b));
}

glm::dvec3 towards(double right_deg, double up_deg) {
    const double azimuth = glm::radians(right_deg);
    const double elevation = glm::radians(up_deg);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            -std::cos(azimuth) * std::cos(elevation)};
}

/// What is true of the rays whatever goes in.
void expect_sane(const PerEye<EyeRay>& rays) {
    for (const EyeRay& ray : rays) {
        ASSERT_TRUE(is_finite(ray.origin_m));
        ASSERT_TRUE(is_finite(ray.direction));
        ASSERT_NEAR(glm::length(ray.direction), 1.0, 1e-12);
    }
}

TEST(CombinedGaze, MeetsAtTheDistance) {
    const glm::dvec3 to = towards(20.0, -10.0);
    const PerEye<EyeRay> rays = eye_rays({glm::dvec3{0.0}, to}, kEyes_m, 0.5);
    for (std::size_t e = 0; e < kEyeCount; ++e) {
        EXPECT_TRUE(rays[e].valid);
        EXPECT_EQ(rays[e].origin_m, kEyes_m[e]);
        EXPECT_LT(angle_rad(rays[e].direction, 0.5 * to - kEyes_m[e]), 1e-12);
    }
}

// 3.6 degrees an eye at half a metre.
TEST(CombinedGaze, HasTheKnownParallax) {
    const PerEye<EyeRay> rays = eye_rays({}, kEyes_m, 0.5);
    EXPECT_NEAR(glm::degrees(angle_rad(rays[0].direction, kStraightAhead)), 3.6, 0.01);
    EXPECT_NEAR(glm::degrees(angle_rad(rays[0].direction, rays[1].direction)), 7.2, 0.02);
    EXPECT_GT(rays[0].direction.x, 0.0) << "the left eye turns to the right";
    EXPECT_LT(rays[1].direction.x, 0.0);
}

TEST(CombinedGaze, IsParallelAtInfinity) {
    const glm::dvec3 to = towards(-30.0, 25.0);
    for (const double distance_m : {kInfinity, std::numeric_limits<double>::max(), 1e12}) {
        const PerEye<EyeRay> rays = eye_rays({glm::dvec3{0.0}, to}, kEyes_m, distance_m);
        for (const EyeRay& ray : rays) {
            EXPECT_LT(angle_rad(ray.direction, to), 1e-12) << distance_m;
        }
    }
}

TEST(CombinedGaze, TakesNoDistanceThatIsNone) {
    const PerEye<EyeRay> least = eye_rays({}, kEyes_m, kLeastMeeting_m);
    for (const double distance_m : {kNan, -1.0, -kInfinity, 0.0, 1e-300}) {
        const PerEye<EyeRay> rays = eye_rays({}, kEyes_m, distance_m);
        expect_sane(rays);
        EXPECT_EQ(rays[0].direction, least[0].direction) << distance_m;
    }
}

TEST(CombinedGaze, MayPointBehindTheHead) {
    const PerEye<EyeRay> rays = eye_rays({glm::dvec3{0.0}, {0.0, 0.0, 1.0}}, kEyes_m, 1.0);
    expect_sane(rays);
    EXPECT_TRUE(rays[0].valid);
    EXPECT_GT(rays[0].direction.z, 0.99);
    EXPECT_GT(rays[0].direction.x, 0.0) << "they meet behind";
}

TEST(CombinedGaze, IsInvalidWithoutADirection) {
    for (const glm::dvec3& none :
         {glm::dvec3{0.0}, glm::dvec3{kNan, 0.0, -1.0}, glm::dvec3{0.0, kInfinity, 0.0}}) {
        const PerEye<EyeRay> rays = eye_rays({glm::dvec3{0.0}, none}, kEyes_m, 1.5);
        EXPECT_FALSE(rays[0].valid);
        EXPECT_FALSE(rays[1].valid);
        expect_sane(rays);
    }
}

TEST(CombinedGaze, TakesEyesThatCannotBeForTheHeadsMiddle) {
    for (const double far : {kNan, kInfinity, 1.0, -1e300}) {
        const PerEye<EyeRay> rays =
            eye_rays({{far, 0.0, 0.0}, kStraightAhead}, {glm::dvec3{far}, kEyes_m[1]}, 1.0);
        expect_sane(rays);
        EXPECT_EQ(rays[0].direction, kStraightAhead) << far;
        EXPECT_LT(rays[1].direction.x, 0.0);
    }
    // An eye that sits just where the rays are to meet.
    const PerEye<EyeRay> at = eye_rays({}, {glm::dvec3{0.0, 0.0, -0.1}, kEyes_m[1]}, 0.1);
    expect_sane(at);
    EXPECT_EQ(at[0].direction, kStraightAhead);
}

TEST(CombinedGaze, StatesNoErrorWhereThereIsNone) {
    EXPECT_EQ(parallax_error_rad({glm::dvec3{0.0}, glm::dvec3{0.0}}, 1.0, {0.5}), 0.0);
    EXPECT_NEAR(parallax_error_rad(kEyes_m, 1.0, {0.5}), 0.0315 / (1.0 - 0.063 * 0.063), 1e-12);
    EXPECT_NEAR(parallax_error_rad(kEyes_m, kInfinity, {0.5}), 0.063 / (1.0 - 0.063 * 0.063),
                1e-12);
}

TEST(CombinedGaze, StatesWhereNothingIsKnown) {
    for (const double nearest_m : {0.03, 1e-300, 1e-310, 0.0, -1.0, -kInfinity, kNan}) {
        EXPECT_EQ(parallax_error_rad(kEyes_m, 1.0, {nearest_m}), std::numbers::pi) << nearest_m;
    }
    EXPECT_LT(parallax_error_rad(kEyes_m, kNan, {0.5}), std::numbers::pi);
    EXPECT_EQ(parallax_error_rad({glm::dvec3{kNan}, kEyes_m[1]}, 1.0, {0.5}), std::numbers::pi);
}

// The less is known of the distance, the larger the error; nothing is left of it where it is known.
TEST(CombinedGaze, StatesLessWhereMoreIsKnown) {
    EXPECT_EQ(parallax_error_rad(kEyes_m, 0.8, {0.8, 0.8}), 0.0);
    EXPECT_EQ(parallax_error_rad(kEyes_m, kInfinity, {kInfinity, kInfinity}), 0.0);
    const double u = 0.0315 / 0.7;
    EXPECT_NEAR(parallax_error_rad(kEyes_m, 0.8, {0.7, 1.0}),
                0.0315 / (1.0 - u * u) * (1.0 / 0.8 - 1.0), 1e-12);
    EXPECT_NEAR(parallax_error_rad(kEyes_m, 1.5, {0.4, 0.5}),
                0.0315 / (1.0 - 0.07875 * 0.07875) * (2.5 - 1.0 / 1.5), 1e-12)
        << "all of the range is nearer";
    EXPECT_GT(parallax_error_rad(kEyes_m, 0.05, {0.05, 0.06}), 0.1);
    for (const double farthest_m : {0.0, -1.0, kNan}) {
        EXPECT_EQ(parallax_error_rad(kEyes_m, 1.0, {0.5, farthest_m}),
                  parallax_error_rad(kEyes_m, 1.0, {0.5, kInfinity}));
    }
}

// Whatever is looked at, at any depth the bound is for: no eye is farther off.
RC_GTEST_PROP(CombinedGazeProperty, IsNeverFartherOffThanStated, ()) {
    const double half_m = between(0.02, 0.04);
    const PerEye<glm::dvec3> eyes_m{glm::dvec3{-half_m, 0.0, 0.0}, glm::dvec3{half_m, 0.0, 0.0}};
    const double nearest_m = between(0.1, 2.0);
    const double distance_m = between(0.1, 10.0);
    const double farthest_m = nearest_m / between(1e-6, 1.0);
    const double depth_m = 1.0 / std::lerp(1.0 / nearest_m, 1.0 / farthest_m, between(0.0, 1.0));
    const glm::dvec3 to = towards(between(-90.0, 90.0), between(-60.0, 60.0));
    const PerEye<EyeRay> rays = eye_rays({glm::dvec3{0.0}, to}, eyes_m, distance_m);
    const double bound_rad = parallax_error_rad(eyes_m, distance_m, {nearest_m, farthest_m});
    for (const EyeRay& ray : rays) {
        RC_ASSERT(angle_rad(ray.direction, depth_m * to - ray.origin_m) <= bound_rad + 1e-12);
    }
}

}  // namespace
}  // namespace gazeloop::gaze
