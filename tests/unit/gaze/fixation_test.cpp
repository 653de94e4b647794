#include "runtime/gaze/fixation.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "tests/unit/gaze/painted_depth.h"

namespace gazeloop::gaze {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
constexpr double kEverywhere_m = 1e3;

Scene wide_wall(double z_m) { return wall(z_m, -kEverywhere_m, kEverywhere_m); }

/// Keeps of each patch what lies within so many samples of where its eye would look to meet the
/// other one at a distance along a direction: what a renderer reads back of a disc.
SeenDepth around(const SeenDepth& seen, const glm::dvec3& direction, double distance_m,
                 std::uint32_t across, std::uint32_t down) {
    SeenDepth cut;
    for (std::size_t e = 0; e < kEyeCount; ++e) {
        const DepthPatch& all = seen[e];
        const PixelPosition at =
            project(distance_m * direction - all.view.pose.position_m, all.view);
        const auto column = static_cast<std::uint32_t>(at.x_px / all.step_x_px);
        const auto row = static_cast<std::uint32_t>(at.y_px / all.step_y_px);
        cut[e] = all;
        cut[e].x0_px = (column - across) * all.step_x_px;
        cut[e].y0_px = (row - down) * all.step_y_px;
        cut[e].columns = 2 * across + 1;
        cut[e].rows = 2 * down + 1;
        cut[e].nearness.clear();
        for (std::uint32_t r = row - down; r <= row + down; ++r) {
            for (std::uint32_t c = column - across; c <= column + across; ++c) {
                cut[e].nearness.push_back(all.nearness[r * all.columns + c]);
            }
        }
    }
    return cut;
}

/// What half floats and a sample's size leave of a distance, 1/m.
constexpr double kNearnessError = 0.01;

TEST(Fixation, IsOnTheWallThatIsLookedAt) {
    for (const double z_m : {0.12, 0.25, 0.4, 1.0, 3.0, 50.0}) {
        const SeenDepth seen = painted(wide_wall(z_m));
        for (const auto& [right_deg, up_deg] : {std::pair{0.0, 0.0}, {8.0, -5.0}, {-15.0, 10.0}}) {
            const glm::dvec3 direction = towards_deg(right_deg, up_deg);
            const auto fixation = find_fixation({glm::dvec3{0.0}, direction}, seen);
            ASSERT_TRUE(fixation.has_value()) << z_m;
            EXPECT_NEAR(fixation->nearness, -direction.z / z_m, kNearnessError + 0.002 / z_m)
                << z_m;
            EXPECT_LE(fixation->range.nearest_m, 1.0 / fixation->nearness);
            EXPECT_GE(fixation->range.farthest_m, 1.0 / fixation->nearness);
            EXPECT_LT(fixation->range.farthest_m, 1.1 * z_m / -direction.z);
        }
    }
}

TEST(Fixation, IsEndlessInTheSky) {
    const auto fixation = find_fixation({}, painted([](const auto&, const auto&) { return 0.0; }));
    ASSERT_TRUE(fixation.has_value());
    EXPECT_EQ(fixation->nearness, 0.0);
    EXPECT_EQ(fixation->range.nearest_m, kInfinity);
    EXPECT_EQ(fixation->range.farthest_m, kInfinity);
}

// 4 cm wide and 40 cm away: eyes that were set to 1.5 m both look past it.
TEST(Fixation, FindsWhatBothEyesLookPast) {
    const glm::dvec3 ahead = towards_deg(0.0, 0.0);
    const SeenDepth seen =
        around(painted(both(wall(0.4, -0.02, 0.02), wide_wall(3.0))), ahead, 1.5, 33, 8);
    const auto fixation = find_fixation({glm::dvec3{0.0}, ahead}, seen);
    ASSERT_TRUE(fixation.has_value());
    EXPECT_NEAR(fixation->nearness, 2.5, kNearnessError);
}

// Beside an edge one eye sees the far wall where the other sees the near one. Which is looked at
// depends on the gaze alone, whatever distance the picture's foveae were made for; so that what
// follows from it in the next frame is the same again.
TEST(Fixation, DependsOnTheGazeNotOnWhatWasAssumed) {
    const SeenDepth seen = painted(both(wall(0.4, -1.0, 0.0), wide_wall(1.5)));
    for (double right_deg = -5.05; right_deg <= 5.05; right_deg += 0.37) {
        if (std::abs(right_deg) < 0.25) {
            continue;  // nearer to the edge than samples are to each other
        }
        const glm::dvec3 direction = towards_deg(right_deg, 0.0);
        const double truth = right_deg < 0.0 ? 1.0 / 0.4 : 1.0 / 1.5;
        for (const double assumed_m : {0.4, 0.55, 1.5, 1e6}) {
            const auto fixation = find_fixation({glm::dvec3{0.0}, direction},
                                                around(seen, direction, assumed_m, 33, 8));
            ASSERT_TRUE(fixation.has_value()) << right_deg;
            EXPECT_NEAR(fixation->nearness, truth * -direction.z, 2.0 * kNearnessError)
                << right_deg << " deg, pictures for " << assumed_m << " m";
        }
    }
}

// A patch narrower than from infinity to the hand: what is found first is kept or gives way to
// what is nearer, once. The foveae never go back and forth.
TEST(Fixation, SettlesWithNarrowPatchesToo) {
    const SeenDepth seen = painted(both(wall(0.4, -1.0, 0.0), wide_wall(1.5)));
    for (const std::uint32_t across : {4U, 8U, 12U, 16U}) {
        for (double right_deg = -3.0; right_deg <= 3.0; right_deg += 0.21) {
            const glm::dvec3 direction = towards_deg(right_deg, 0.0);
            for (const double assumed_m : {0.3, 0.7, 1.5, 10.0}) {
                double distance_m = assumed_m;
                std::vector<double> found;
                for (int frame = 0; frame < 12; ++frame) {
                    const auto fixation =
                        find_fixation({glm::dvec3{0.0}, direction},
                                      around(seen, direction, distance_m, across, 8));
                    distance_m = fixation ? 1.0 / fixation->nearness : assumed_m;
                    found.push_back(distance_m);
                }
                EXPECT_NEAR(1.0 / found[11], 1.0 / found[3], kNearnessError)
                    << across << ' ' << right_deg << ' ' << assumed_m;
            }
        }
    }
}

TEST(Fixation, FollowsTheHead) {
    const Pose then{glm::angleAxis(0.2, glm::dvec3{0.0, 1.0, 0.0}), {0.1, 0.05, 0.0}};
    const SeenDepth seen = painted(wide_wall(0.8), then);
    // The head has turned back and moved on since; the gaze still is on the wall, seen in world.
    const glm::dvec3 direction = towards_deg(-10.0, 3.0);
    const auto fixation = find_fixation({{0.12, 0.04, -0.03}, direction}, seen);
    ASSERT_TRUE(fixation.has_value());
    EXPECT_NEAR(fixation->nearness, -direction.z / 0.77, 2.0 * kNearnessError);
}

TEST(Fixation, RangesOverWhatTheTrackersAccuracyLeaves) {
    const Scene scene = both(wall(0.6, 0.005, 1.0), wide_wall(2.0));  // the edge is .5 deg off
    const glm::dvec3 ahead = towards_deg(0.0, 0.0);
    const auto beside = find_fixation({glm::dvec3{0.0}, ahead}, painted(scene));
    ASSERT_TRUE(beside.has_value());
    EXPECT_NEAR(beside->nearness, 0.5, kNearnessError);
    EXPECT_NEAR(beside->range.farthest_m, 2.0, 0.02);
    EXPECT_NEAR(beside->range.nearest_m, 0.6, 0.01);
    const auto away = find_fixation({glm::dvec3{0.0}, towards_deg(-6.0, 0.0)}, painted(scene));
    ASSERT_TRUE(away.has_value());
    EXPECT_GT(away->range.nearest_m, 1.9);
}

// Where a patch does not show it all, the range is the general one.
TEST(Fixation, ClaimsNothingThatWasNotSeen) {
    const glm::dvec3 ahead = towards_deg(0.0, 0.0);
    const SeenDepth seen = painted(wide_wall(2.0));
    const auto whole = find_fixation({glm::dvec3{0.0}, ahead}, around(seen, ahead, 2.0, 33, 8));
    EXPECT_NEAR(whole->range.nearest_m, 2.0, 0.02);
    const auto low = find_fixation({glm::dvec3{0.0}, ahead}, around(seen, ahead, 2.0, 33, 2));
    EXPECT_NEAR(low->nearness, 0.5, kNearnessError);
    EXPECT_EQ(low->range.nearest_m, kNearestContent_m);
    EXPECT_EQ(low->range.farthest_m, kInfinity);
    // Up to .5 m something may stand where neither eye was shown.
    const auto narrow = find_fixation({glm::dvec3{0.0}, ahead}, around(seen, ahead, 2.0, 9, 8));
    EXPECT_NEAR(narrow->nearness, 0.5, kNearnessError);
    EXPECT_NEAR(narrow->range.nearest_m, kNearestContent_m, 0.02);
    EXPECT_NEAR(narrow->range.farthest_m, 2.0, 0.03);
}

TEST(Fixation, IsNoneWhereNothingIsSeen) {
    const glm::dvec3 ahead = towards_deg(0.0, 0.0);
    const SeenDepth seen = painted(wide_wall(1.0));
    EXPECT_FALSE(find_fixation({glm::dvec3{0.0}, ahead}, {}).has_value());
    EXPECT_FALSE(find_fixation({glm::dvec3{0.0}, towards_deg(60.0, 0.0)}, seen).has_value());
    EXPECT_FALSE(find_fixation({glm::dvec3{0.0}, towards_deg(180.0, 0.0)}, seen).has_value());
    EXPECT_FALSE(find_fixation({glm::dvec3{0.0}, glm::dvec3{0.0}}, seen).has_value());
    EXPECT_FALSE(find_fixation({glm::dvec3{kNan}, ahead}, seen).has_value());
    EXPECT_FALSE(find_fixation({glm::dvec3{0.0}, {0.0, kInfinity, -1.0}}, seen).has_value());
}

// Each eye meets another surface on the gaze, as where something came between the two pictures.
TEST(Fixation, IsTheNearestThatEitherEyeMeets) {
    const SeenDepth near = painted(wide_wall(0.4));
    const SeenDepth far = painted(wide_wall(3.0));
    for (const SeenDepth& seen : {SeenDepth{near[0], far[1]}, SeenDepth{far[0], near[1]}}) {
        const auto fixation = find_fixation({}, seen);
        ASSERT_TRUE(fixation.has_value());
        EXPECT_NEAR(fixation->nearness, 2.5, 2.0 * kNearnessError);
    }
}

TEST(Fixation, IsOneEyesWhereTheOtherSeesNothing) {
    SeenDepth seen = painted(wide_wall(0.5));
    seen[1] = {};
    const auto fixation = find_fixation({}, seen);
    ASSERT_TRUE(fixation.has_value());
    EXPECT_NEAR(fixation->nearness, 2.0, kNearnessError);
}

TEST(Fixation, TakesNoSampleThatIsNoDistance) {
    constexpr std::uint16_t kHalves[] = {0x7C00, 0x7E00, 0xFC00, 0xC000, 0x8001};
    for (const std::uint16_t half : kHalves) {
        SeenDepth seen = painted(wide_wall(0.5));
        for (DepthPatch& patch : seen) {
            patch.nearness.assign(patch.nearness.size(), half);
        }
        EXPECT_FALSE(find_fixation({}, seen).has_value()) << half;
    }
}

TEST(Fixation, WorksWithBothEyesInOnePlace) {
    SeenDepth seen = painted(wide_wall(0.5), {.position_m = {kHalfBetweenEyes_m, 0.0, 0.0}});
    seen[1] = seen[0];
    const auto fixation = find_fixation({}, seen);
    ASSERT_TRUE(fixation.has_value());
    EXPECT_NEAR(fixation->nearness, 2.0, kNearnessError);
}

// From 20 thousand kilometres to 15 micrometres.
TEST(Fixation, ReadsEveryHalfFloat) {
    constexpr std::uint16_t kInfinite = 0x7C00;
    SeenDepth seen;
    for (DepthPatch& patch : seen) {
        patch.view = {.pose = {}, .fov = {-0.5, 0.5, 0.5, -0.5}, .width_px = 3, .height_px = 3};
        patch.columns = 3;
        patch.rows = 3;
    }
    for (std::uint16_t half = 0; half < kInfinite; ++half) {
        for (DepthPatch& patch : seen) {
            patch.nearness.assign(9, half);
        }
        const auto fixation = find_fixation({}, seen);
        ASSERT_TRUE(fixation.has_value()) << half;
        ASSERT_DOUBLE_EQ(fixation->nearness, glm::unpackHalf1x16(half)) << half;
    }
}

// Any samples, patches and gazes: no crash, and what comes out is a distance within its range.
RC_GTEST_PROP(FixationProperty, IsWithinItsRange, ()) {
    SeenDepth seen;
    for (DepthPatch& patch : seen) {
        patch.view.width_px = *rc::gen::inRange(1U, 200U);
        patch.view.height_px = *rc::gen::inRange(1U, 200U);
        patch.view.fov = {-0.01 * *rc::gen::inRange(1, 150), 0.01 * *rc::gen::inRange(1, 150),
                          0.01 * *rc::gen::inRange(1, 150), -0.01 * *rc::gen::inRange(1, 150)};
        patch.view.pose.position_m = {0.01 * *rc::gen::inRange(-9, 9), 0.0,
                                      0.01 * *rc::gen::inRange(-9, 9)};
        patch.step_x_px = *rc::gen::inRange(1U, 4U);
        patch.step_y_px = *rc::gen::inRange(1U, 4U);
        patch.columns = patch.view.width_px / patch.step_x_px;
        patch.rows = patch.view.height_px / patch.step_y_px;
        const auto some = *rc::gen::container<std::vector<std::uint16_t>>(
            16, rc::gen::arbitrary<std::uint16_t>());
        for (std::size_t i = 0; i < std::size_t{patch.columns} * patch.rows; ++i) {
            patch.nearness.push_back(some[i * 7 % 16]);
        }
    }
    const auto fixation = find_fixation(
        {glm::dvec3{0.0}, towards_deg(*rc::gen::inRange(-180, 180), *rc::gen::inRange(-90, 90))},
        seen);
    if (fixation) {
        RC_ASSERT(std::isfinite(fixation->nearness) && fixation->nearness >= 0.0);
        RC_ASSERT(fixation->range.nearest_m > 0.0);
        RC_ASSERT(1.0 / fixation->range.nearest_m >= fixation->nearness * (1.0 - 1e-12));
        RC_ASSERT(1.0 / fixation->range.farthest_m <= fixation->nearness * (1.0 + 1e-12));
    }
}

}  // namespace
}  // namespace gazeloop::gaze
