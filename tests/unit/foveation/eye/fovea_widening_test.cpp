#include "runtime/foveation/eye/fovea_widening.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/foveation/eye/geisler_perry_acuity.h"
#include "runtime/foveation/eye/guenter_acuity.h"
#include "runtime/foveation/eye/stela_acuity.h"

namespace gazeloop::foveation {
namespace {

TEST(Widening, IsTheSumOfWhatIsNotKnown) {
    EXPECT_EQ(widening_deg({}).value(), 0.0);
    // 1.13 + 2 sqrt(.14^2 + .48^2) + 30 x .05 + 84 x .02 + .25
    const GazeUncertainty all{.bias95_deg = 1.13,
                              .z = 2.0,
                              .sample_sd_deg = 0.14,
                              .filter_sd_deg = 0.48,
                              .pursuit_deg_s = 30.0,
                              .latency_s = 0.05,
                              .head_rate_deg_s = 84.0,
                              .gaze_age_s = 0.02,
                              .saccade_residual_deg = 0.25};
    EXPECT_NEAR(widening_deg(all).value(), 1.13 + 1.0 + 1.5 + 1.68 + 0.25, 1e-12);
    EXPECT_EQ(widening_deg({.saccade_residual_deg = 1e300}).value(), kMaxWideningDeg);
}

TEST(Widening, RefusesWithTheNameAndTheValue) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const double bad : {-0.1, kNan, kInfinity}) {
        const auto widened = widening_deg({.latency_s = bad});
        ASSERT_FALSE(widened.has_value());
        EXPECT_EQ(widened.error().kind, ErrorKind::Usage);
        EXPECT_THAT(widened.error().message, testing::HasSubstr("latency_s = "));
    }
}

TEST(TrackerBias, OfNearlyAllFollowsFromThatOfHalf) {
    EXPECT_NEAR(bias95_deg(0.43), 1.13, 0.03);
    EXPECT_NEAR(bias95_deg(0.61), 1.56, 0.03);
    EXPECT_NEAR(bias95_deg(0.89), 2.30, 0.03);
    EXPECT_EQ(bias95_deg(0.0), 0.0);
}

TEST(WidenedAcuity, MovesTheFoveaOutward) {
    const GeislerPerryAcuity model;
    const WidenedAcuity widened(model, 3.0);
    EXPECT_EQ(widened.cutoff_cpd(0.0, 0.0), model.cutoff_cpd(0.0, 0.0));
    EXPECT_EQ(widened.cutoff_cpd(3.0, 0.0), model.cutoff_cpd(0.0, 0.0));
    EXPECT_EQ(widened.cutoff_cpd(10.0, 0.0), model.cutoff_cpd(7.0, 0.0));
    EXPECT_EQ(widened.name(), model.name());
}

// Displays absorb e_c = (2 / p - omega0) / m for free, p pixels a degree at the centre.
TEST(DisplayLimit, IsTheReferenceEccentricities) {
    const auto line = GuenterAcuity::create({.slope = 0.022}).value();
    const auto limit = [&](double width_px, double fov_deg) {
        constexpr double kPi = std::numbers::pi;
        const double half = std::tan(fov_deg / 360.0 * kPi);
        return display_limit_deg(*line, width_px / (2 * half) * kPi / 180.0, 0.0);
    };
    EXPECT_NEAR(limit(1280, 100), 8.75, 0.01);
    EXPECT_NEAR(limit(2160, 100), 4.8, 0.02);
    EXPECT_NEAR(limit(3840, 120), 3.75, 0.01);
    EXPECT_NEAR(display_limit_deg(*line, 60.0, 0.0), 0.57, 0.005);
    EXPECT_EQ(display_limit_deg(*line, 97.0, 0.0), 0.0);    // finer than the fovea
    EXPECT_EQ(display_limit_deg(*line, 0.01, 0.0), 180.0);  // coarser than anything
    const auto stela = StelaAcuity::create({}, StelaField::TemporalEverywhere).value();
    EXPECT_NEAR(display_limit_deg(*stela, 2 * 9.5, 0.0), 10.0, 0.05);
}

}  // namespace
}  // namespace gazeloop::foveation
