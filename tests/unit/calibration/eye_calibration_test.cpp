#include "runtime/calibration/eye_calibration.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "runtime/gaze/direction.h"

namespace gazeloop::calibration {
namespace {

glm::dvec3 towards(double right_deg, double up_deg) {
    return direction_of({glm::radians(right_deg), glm::radians(up_deg)});
}

double apart_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(gaze::angle_between(a, b));
}

EyeCalibration bent() {
    return {.azimuth = {0.05, -0.1, 0.03, 0.4, -0.2, 0.1},
            .elevation = {-0.02, 0.04, 0.1, -0.3, 0.1, 0.2},
            .reach_rad = glm::radians(20.0)};
}

TEST(EyeCalibration, AnglesAreThoseOfTheDirection) {
    EXPECT_EQ(direction_of({0.0, 0.0}), gaze::kStraightAhead);
    // 30 deg to the right, 30 up: (cos 30 sin 30, sin 30, -cos 30 cos 30).
    const glm::dvec3 d = towards(30.0, 30.0);
    EXPECT_NEAR(d.x, 0.4330127018922193, 1e-15);
    EXPECT_NEAR(d.y, 0.5, 1e-15);
    EXPECT_NEAR(d.z, -0.75, 1e-15);
    const GazeAngles back = angles_of(d);
    EXPECT_NEAR(back.azimuth_rad, glm::radians(30.0), 1e-15);
    EXPECT_NEAR(back.elevation_rad, glm::radians(30.0), 1e-15);
}

TEST(EyeCalibration, AddsItsQuadratic) {
    // At (.1, .2): azimuth .05 - .01 + .006 + .004 - .004 + .004 = .05 more; elevation -.02 + .004
    // + .02 - .003 + .002 + .008 = .011 more.
    const GazeAngles at = angles_of(corrected(bent(), direction_of({0.1, 0.2})));
    EXPECT_NEAR(at.azimuth_rad, 0.15, 1e-14);
    EXPECT_NEAR(at.elevation_rad, 0.211, 1e-14);
    EXPECT_NEAR(glm::length(corrected(bent(), towards(-7.0, 3.0))), 1.0, 1e-15);
    EXPECT_NEAR(apart_deg(corrected({}, towards(80.0, -60.0)), towards(80.0, -60.0)), 0.0, 1e-9);
}

TEST(EyeCalibration, IsConstantBeyondItsReach) {
    const auto added = [](double right_deg) {
        return glm::degrees(angles_of(corrected(bent(), towards(right_deg, 0.0))).azimuth_rad) -
               right_deg;
    };
    EXPECT_NEAR(added(20.0), added(60.0), 1e-9);
    EXPECT_NEAR(added(20.0), added(20.0 + 1e-9), 1e-6) << "without a step";
    EXPECT_GT(std::abs(added(20.0) - added(10.0)), 0.1);
    EXPECT_NEAR(glm::length(corrected(bent(), {0.0, 1.0, 0.0})), 1.0, 1e-15);
    EXPECT_NEAR(glm::length(corrected(bent(), {0.0, 0.0, 1.0})), 1.0, 1e-15);
}

TEST(EyeCalibration, CanBeUndone) {
    for (double right = -40.0; right <= 40.0; right += 8.0) {
        for (double up = -30.0; up <= 30.0; up += 6.0) {
            const glm::dvec3 stated = towards(right, up);
            const auto undone = uncorrected(bent(), corrected(bent(), stated));
            ASSERT_TRUE(undone.has_value()) << right << ' ' << up;
            EXPECT_LT(gaze::angle_between(*undone, stated), 2e-9) << right << ' ' << up;
        }
    }
    EyeCalibration folded;  // azimuth 0 becomes 1 everywhere within the reach: nothing gives 0
    folded.azimuth = {1.0, -1.0, 0.0, 0.0, 0.0, 0.0};
    folded.reach_rad = 3.0;
    EXPECT_FALSE(uncorrected(folded, gaze::kStraightAhead).has_value());
}

TEST(EyeCalibration, ComesBackFromItsValuesBitForBit) {
    EyeCalibration other = bent();
    other.azimuth[3] = -1.0 / 3.0;
    other.elevation[0] = 1e-300;
    for (const Calibration& calibration :
         {Calibration{bent(), other}, Calibration{bent(), std::nullopt},
          Calibration{std::nullopt, other}, Calibration{}}) {
        const auto read = read_values(values_text(calibration));
        ASSERT_TRUE(read.has_value()) << read.error().message;
        EXPECT_EQ(*read, calibration);
    }
}

TEST(EyeCalibration, RefusesValuesThatAreNone) {
    const std::string good = values_text({bent(), bent()});
    const auto message = [](const std::string& text) {
        const auto read = read_values(text);
        EXPECT_FALSE(read.has_value()) << text;
        return read ? std::string() : read.error().message;
    };
    EXPECT_NE(message("").find("0 numbers"), std::string::npos);
    EXPECT_NE(message(good + ",1").find("27 numbers"), std::string::npos);
    EXPECT_NE(message(good + ",").find("the last number is missing"), std::string::npos);
    EXPECT_NE(message("1,x" + good.substr(3)).find("number 2 is none"), std::string::npos);
    EXPECT_NE(message("nan" + good.substr(good.find(','))).find("number 1"), std::string::npos);
    EXPECT_NE(message("101" + good.substr(good.find(','))).find("out of range"), std::string::npos);
    EXPECT_NE(message(good.substr(0, good.rfind(',')) + ",-1").find("out of range"),
              std::string::npos);
    EXPECT_NE(message(good.substr(0, good.rfind(',')) + ",4").find("out of range"),
              std::string::npos);
}

}  // namespace
}  // namespace gazeloop::calibration
