#include "runtime/gaze/fovea_uncertainty.h"

#include <gtest/gtest.h>

#include <glm/trigonometric.hpp>
#include <limits>

#include "runtime/gaze/gaze_to_fovea.h"

namespace gazeloop::gaze {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr UncertaintyPolicy kPolicy{.median_error_deg = 0.5,
                                    .noise_deg = 0.25,
                                    .pursuit_deg_per_s = 10.0,
                                    .head_deg_per_s = 40.0,
                                    .lost_deg_per_s = 30.0,
                                    .greatest_deg = 20.0};

double deg_of(const KnownGaze& known, const UncertaintyPolicy& policy = kPolicy) {
    return glm::degrees(uncertainty_rad(policy, known));
}

TEST(FoveaUncertainty, IsTheSumOfItsTerms) {
    KnownGaze known{.state = FoveaState::Tracking, .head_known = true, .age_ns = 50 * kMs};
    // 2.6 x .5 + 1.96 x .25 + 10 deg/s x 50 ms
    EXPECT_NEAR(deg_of(known), 1.3 + 0.49 + 0.5, 1e-9);
    known.head_known = false;
    EXPECT_NEAR(deg_of(known), 1.3 + 0.49 + 0.5 + 2.0, 1e-9);
    known.parallax_rad = glm::radians(1.5);
    EXPECT_NEAR(deg_of(known), 5.79, 1e-9);
    // The sample's own covariance counts, along its worse axis: SD 1 deg.
    const double variance = glm::radians(1.0) * glm::radians(1.0);
    known.covariance = {0.25 * variance, 0.0, variance};
    EXPECT_NEAR(deg_of(known), 5.79 - 0.49 + 1.96, 1e-9);
}

TEST(FoveaUncertainty, CountsAPredictionInPlaceOfTheLatencyThatItCovers) {
    KnownGaze known{.state = FoveaState::Tracking, .head_known = true, .age_ns = 50 * kMs};
    known.predicted = {.uncertainty_rad = glm::radians(0.7), .horizon_ns = 30 * kMs};
    // 2.6 x .5 + 1.96 x .25 + 10 deg/s x 20 ms + .7
    EXPECT_NEAR(deg_of(known), 1.3 + 0.49 + 0.2 + 0.7, 1e-9);
    known.predicted->horizon_ns = 60 * kMs;
    EXPECT_NEAR(deg_of(known), 1.3 + 0.49 + 0.7, 1e-9) << "it covers no more than all";
    known.head_known = false;
    EXPECT_NEAR(deg_of(known), 1.3 + 0.49 + 0.7 + 2.0, 1e-9) << "of the head it knows nothing";
    known.predicted->uncertainty_rad = 1e300;
    EXPECT_NEAR(deg_of(known), 20.0, 1e-9);
}

TEST(FoveaUncertainty, GrowsWhileGazeIsHeldUpToItsGreatest) {
    KnownGaze known{.state = FoveaState::Held, .head_known = true, .age_ns = 200 * kMs};
    EXPECT_NEAR(deg_of(known), 1.3 + 0.49 + 2.0 + 6.0, 1e-9);
    known.age_ns = 10'000 * kMs;
    EXPECT_NEAR(deg_of(known), 20.0, 1e-9);
    for (const FoveaState state : {FoveaState::Returning, FoveaState::Ahead}) {
        EXPECT_NEAR(deg_of({.state = state, .age_ns = 0}), 20.0, 1e-9);
    }
    EXPECT_NEAR(deg_of({.state = FoveaState::Tracking}), 20.0, 1e-9) << "of unknown age";
}

TEST(FoveaUncertainty, StaysInRangeWhateverIsStated) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInf = std::numeric_limits<double>::infinity();
    for (const double odd : {kNan, kInf, -1.0, 1e300}) {
        const double deg = deg_of({.state = FoveaState::Tracking,
                                   .covariance = DirectionCovariance{odd, 0.0, odd},
                                   .head_known = true,
                                   .age_ns = 0});
        EXPECT_GE(deg, 0.0) << odd;
        EXPECT_LE(deg, 20.0 + 1e-9) << odd;
    }
    EXPECT_NEAR(deg_of({.state = FoveaState::Tracking,
                        .head_known = true,
                        .age_ns = std::numeric_limits<std::int64_t>::min()}),
                1.79, 1e-9)
        << "a sample from the future is as new as can be";
    EXPECT_NEAR(
        deg_of({.state = FoveaState::Tracking, .age_ns = std::numeric_limits<std::int64_t>::max()}),
        20.0, 1e-9);
}

TEST(FoveaUncertainty, TravelsWithTheFoveaOfTheDisplayTime) {
    const double quarter = 0.785398163397448;
    const EyeView view{.pose = {},
                       .fov = {-quarter, quarter, quarter, -quarter},
                       .width_px = 100,
                       .height_px = 100};
    GazeSample sample;
    sample.sampled = sample.arrived = {0, time::StampKind::Modelled};
    sample.head = Pose{};
    sample.eyes[0].valid = true;
    sample.eyes[0].covariance = DirectionCovariance{};
    const auto latched = [&](const FoveaPolicy& policy, time::Stamp display) {
        GazeToFovea gaze(policy);
        gaze.add(sample);
        return gaze.latch({20 * kMs, time::StampKind::Modelled}, {}, {view, view}, display);
    };
    EXPECT_FALSE(latched({}, {}).eyes[0].uncertainty_rad.has_value());
    FoveaPolicy widening;
    widening.uncertainty = kPolicy;
    const FrameFovea at_latch = latched(widening, {});
    EXPECT_NEAR(glm::degrees(at_latch.eyes[0].uncertainty_rad.value()), 1.3 + 0.2, 1e-9);
    // The right eye borrows the left one's direction, and its covariance.
    EXPECT_EQ(at_latch.eyes[1].state, FoveaState::OtherEye);
    EXPECT_EQ(at_latch.eyes[1].uncertainty_rad, at_latch.eyes[0].uncertainty_rad);
    const FrameFovea shown = latched(widening, {60 * kMs, time::StampKind::Predicted});
    EXPECT_NEAR(glm::degrees(shown.eyes[0].uncertainty_rad.value()), 1.3 + 0.6, 1e-9);
    EXPECT_EQ(shown.eyes[0].position.x_px, latched({}, {}).eyes[0].position.x_px);
}

}  // namespace
}  // namespace gazeloop::gaze
