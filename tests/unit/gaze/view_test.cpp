#include "runtime/gaze/view.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <numbers>

namespace gazeloop::gaze {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Tangents -1, .5, .8 and -1.2, so that pixels can be worked out by hand.
EyeView asymmetric_view() {
    return {.pose = {},
            .fov = {.left_rad = -std::atan(1.0),
                    .right_rad = std::atan(0.5),
                    .up_rad = std::atan(0.8),
                    .down_rad = -std::atan(1.2)},
            .width_px = 1500,
            .height_px = 2000};
}

void expect_at(const PixelPosition& position, double x_px, double y_px) {
    EXPECT_NEAR(position.x_px, x_px, 1e-9);
    EXPECT_NEAR(position.y_px, y_px, 1e-9);
}

TEST(Project, StraightAheadFallsOffTheCentreOfAnAsymmetricView) {
    // 1 of 1.5 across, .8 of 2 down.
    expect_at(project({0.0, 0.0, -1.0}, asymmetric_view()), 1000.0, 800.0);
}

TEST(Project, PutsTheCornersOnTheCorners) {
    const EyeView view = asymmetric_view();
    expect_at(project({-1.0, 0.8, -1.0}, view), 0.0, 0.0);
    expect_at(project({0.5, 0.8, -1.0}, view), 1500.0, 0.0);
    expect_at(project({-1.0, -1.2, -1.0}, view), 0.0, 2000.0);
    expect_at(project({0.5, -1.2, -1.0}, view), 1500.0, 2000.0);
}

TEST(Project, DoesNotDependOnTheLength) {
    const EyeView view = asymmetric_view();
    for (const double length : {1e-300, 0.25, 7.0, 1e300}) {
        expect_at(project(length * glm::dvec3{0.1, 0.2, -1.0}, view), 1100.0, 600.0);
    }
}

TEST(Project, GoesPastTheEdgeForADirectionPastTheEdge) {
    expect_at(project({1.0, 0.0, -1.0}, asymmetric_view()), 2000.0, 800.0);
    expect_at(project({0.0, 1.8, -1.0}, asymmetric_view()), 1000.0, -1000.0);
}

TEST(Project, StopsAtTheLimitInTheSameDirectionFromTheCentre) {
    const EyeView view = asymmetric_view();
    // Unlimited it would be at x = 101000, y = 800: (100250, -200) from the centre (750, 1000).
    // 2.5 widths are 3750 px, and -200 * 3750 / 100250 = -7.4813.
    const PixelPosition far = project({100.0, 0.0, -1.0}, view);
    EXPECT_NEAR(far.x_px, 750.0 + 3750.0, 1e-9);
    EXPECT_NEAR(far.y_px, 1000.0 - 7.481296758, 1e-6);
    const PixelPosition nearer = project({100.0, 0.0, -1.0}, view, 1.0);
    EXPECT_NEAR(nearer.x_px, 750.0 + 1500.0, 1e-9);
}

TEST(Project, GoesToTheLimitAtTheImagePlaneAndBehindIt) {
    const EyeView view = asymmetric_view();
    for (const double z : {0.0, 1e-12, 0.5, 100.0}) {
        expect_at(project({1.0, 0.0, z}, view), 4500.0, 1000.0);
        expect_at(project({-1.0, 0.0, z}, view), -3000.0, 1000.0);
        expect_at(project({0.0, 1.0, z}, view), 750.0, -4000.0);
        expect_at(project({0.0, -1.0, z}, view), 750.0, 6000.0);
        // 1000 px per unit tangent on both axes: (1, 1) reaches 3750 first.
        expect_at(project({1.0, 1.0, z}, view), 4500.0, -2750.0);
    }
}

TEST(Project, IsContinuousAcrossTheImagePlane) {
    const EyeView view = asymmetric_view();
    const PixelPosition in_front = project({0.3, -0.7, -1e-9}, view);
    const PixelPosition behind = project({0.3, -0.7, 1e-9}, view);
    EXPECT_NEAR(in_front.x_px, behind.x_px, 1e-3);
    EXPECT_NEAR(in_front.y_px, behind.y_px, 1e-3);
}

TEST(Project, IsOffScreenStraightBehind) {
    const PixelPosition behind = project({0.0, 0.0, 1.0}, asymmetric_view());
    EXPECT_GT(behind.x_px, 1500.0);
    EXPECT_TRUE(std::isfinite(behind.y_px));
}

TEST(Project, TakesUnusableDirectionsAsStraightAhead) {
    const EyeView view = asymmetric_view();
    for (const glm::dvec3& direction :
         {glm::dvec3{kNan, 0.0, -1.0}, glm::dvec3{0.0, kNan, -1.0}, glm::dvec3{0.0, 0.0, kNan},
          glm::dvec3{kInfinity, 0.0, -1.0}, glm::dvec3{0.0, -kInfinity, -1.0},
          glm::dvec3{0.0, 0.0, -kInfinity}, glm::dvec3{0.0, 0.0, 0.0}}) {
        expect_at(project(direction, view), 1000.0, 800.0);
    }
}

TEST(Project, StaysWithinTheLimitWhereStraightAheadIsFarOutsideThePicture) {
    EyeView view = asymmetric_view();
    view.fov.left_rad = std::atan(20.0);
    view.fov.right_rad = std::atan(21.0);
    const PixelPosition ahead = project({0.0, 0.0, -1.0}, view);
    EXPECT_DOUBLE_EQ(ahead.x_px, 750.0 - 3750.0);
    // In the middle of the picture nothing is limited.
    expect_at(project({20.5, 0.8, -1.0}, view), 750.0, 0.0);
}

TEST(Unproject, GivesTheDirectionOfAPixel) {
    const glm::dvec3 direction = unproject({1100.0, 600.0}, asymmetric_view());
    EXPECT_NEAR(glm::length(direction), 1.0, 1e-15);
    EXPECT_NEAR(direction.x / -direction.z, 0.1, 1e-12);
    EXPECT_NEAR(direction.y / -direction.z, 0.2, 1e-12);
}

TEST(IsValid, TakesAnOrdinaryView) { EXPECT_TRUE(is_valid(asymmetric_view())); }

TEST(IsValid, RefusesWhatCannotBeProjectedWith) {
    const auto refused = [](auto change) {
        EyeView view = asymmetric_view();
        change(view);
        return !is_valid(view);
    };
    EXPECT_TRUE(refused([](EyeView& v) { v.width_px = 0; }));
    EXPECT_TRUE(refused([](EyeView& v) { v.height_px = 0; }));
    EXPECT_TRUE(refused([](EyeView& v) { v.fov.left_rad = v.fov.right_rad; }));
    EXPECT_TRUE(refused([](EyeView& v) { std::swap(v.fov.up_rad, v.fov.down_rad); }));
    EXPECT_TRUE(refused([](EyeView& v) { v.fov.right_rad = std::numbers::pi / 2.0; }));
    EXPECT_TRUE(refused([](EyeView& v) { v.fov.down_rad = -2.0; }));
    EXPECT_TRUE(refused([](EyeView& v) { v.fov.up_rad = kNan; }));
    EXPECT_TRUE(refused([](EyeView& v) { v.fov.left_rad = -kInfinity; }));
    // Different angles, the same tangent.
    EXPECT_TRUE(refused([](EyeView& v) {
        v.fov.left_rad = 0.0;
        v.fov.right_rad = std::numeric_limits<double>::denorm_min();
    }));
}

}  // namespace
}  // namespace gazeloop::gaze
