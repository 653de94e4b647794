#include "runtime/calibration/steady_gaze.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <random>

#include "runtime/calibration/eye_calibration.h"
#include "runtime/gaze/direction.h"

namespace gazeloop::calibration {
namespace {

/// Normal noise about a direction.
class Noisy {
  public:
    glm::dvec3 about(double right_deg, double up_deg, double sd_deg) {
        return direction_of({glm::radians(right_deg + sd_deg * normal_(random_)),
                             glm::radians(up_deg + sd_deg * normal_(random_))});
    }

  private:
    std::mt19937_64 random_{5};
    std::normal_distribution<double> normal_;
};

TEST(SteadyGaze, IsWhereMostSamplesLie) {
    Noisy noisy;
    SteadyGaze steady;
    for (int i = 0; i < 80; ++i) {
        steady.add(noisy.about(10.0, -5.0, 0.3));
    }
    for (int i = 0; i < 20; ++i) {  // a glance aside
        steady.add(noisy.about(-8.0, 4.0, 0.3));
    }
    steady.add(direction_of({2.5, 0.0}));  // a glitch
    const auto rest = steady.rest();
    ASSERT_TRUE(rest.has_value());
    // .3 deg over 80 samples leaves .05 deg in two axes; the glance would draw the mean off by 4.
    EXPECT_LT(glm::degrees(gaze::angle_between(
                  *rest, direction_of({glm::radians(10.0), glm::radians(-5.0)}))),
              0.15);
    EXPECT_EQ(steady.samples(), 101U);
    steady.clear();
    EXPECT_FALSE(steady.rest().has_value());
}

TEST(SteadyGaze, IsNoneWhereNothingWasFixated) {
    Noisy noisy;
    SteadyGaze few;
    for (std::size_t i = 0; i + 1 < SteadyGaze::kFewest; ++i) {
        few.add(gaze::kStraightAhead);
    }
    EXPECT_FALSE(few.rest().has_value());
    few.add(gaze::kStraightAhead);
    EXPECT_TRUE(few.rest().has_value()) << "a tracker without noise";
    SteadyGaze wandering;
    for (int i = 0; i < 100; ++i) {
        wandering.add(noisy.about(0.0, 0.0, 3.0));
    }
    EXPECT_FALSE(wandering.rest().has_value());
}

}  // namespace
}  // namespace gazeloop::calibration
