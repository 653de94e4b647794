#include "runtime/calibration/target_schedule.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <set>
#include <utility>

#include "runtime/calibration/eye_calibration.h"

namespace gazeloop::calibration {
namespace {

TEST(TargetSchedule, ShowsNinePointsOnceEach) {
    const TargetSchedule schedule;
    const auto targets = schedule.targets();
    ASSERT_EQ(targets.size(), 9U);
    std::set<std::pair<long, long>> places;
    for (const glm::dvec3& target : targets) {
        const GazeAngles angles = angles_of(target);
        places.emplace(std::lround(glm::degrees(angles.azimuth_rad)),
                       std::lround(glm::degrees(angles.elevation_rad)));
    }
    std::set<std::pair<long, long>> expected;
    for (const long x : {-15, 0, 15}) {
        for (const long y : {-10, 0, 10}) {
            expected.emplace(x, y);
        }
    }
    EXPECT_EQ(places, expected);
}

TEST(TargetSchedule, GivesEachItsTime) {
    const TargetSchedule schedule{.shown_s = 2.0, .settling_s = 0.5};
    EXPECT_EQ(schedule.length_s(), 18.0);
    EXPECT_EQ(schedule.at(0.0)->target, 0U);
    EXPECT_FALSE(schedule.at(0.49)->settled);
    EXPECT_TRUE(schedule.at(0.5)->settled);
    EXPECT_EQ(schedule.at(1.99)->target, 0U);
    EXPECT_EQ(schedule.at(2.0)->target, 1U);
    EXPECT_FALSE(schedule.at(2.0)->settled);
    EXPECT_EQ(schedule.at(17.99)->target, 8U);
    for (const double none : {-0.01, 18.0, 1e300, std::numeric_limits<double>::infinity(),
                              std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_FALSE(schedule.at(none).has_value()) << none;
    }
}

}  // namespace
}  // namespace gazeloop::calibration
