#include "runtime/gaze/gaze_to_fovea.h"

#include <gtest/gtest.h>

#include <array>
#include <bit>
#include <cmath>
#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>
#include <vector>

namespace gazeloop::gaze {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kMs = 1'000'000;
constexpr std::size_t kLeft = index(Eye::Left);
constexpr std::size_t kRight = index(Eye::Right);

/// A quarter turn wide and high and 1000 px: 500 px per unit tangent from the middle.
EyeView square_view(const Pose& pose = {}) {
    const double quarter = std::atan(1.0);
    return {.pose = pose,
            .fov = {.left_rad = -quarter,
                    .right_rad = quarter,
                    .up_rad = quarter,
                    .down_rad = -quarter},
            .width_px = 1000,
            .height_px = 1000};
}

glm::dquat yaw(double degrees) {
    return glm::angleAxis(glm::radians(degrees), glm::dvec3{0.0, 1.0, 0.0});
}

glm::dvec3 towards(double right_deg, double up_deg = 0.0) {
    const double azimuth = glm::radians(right_deg);
    const double elevation = glm::radians(up_deg);
    return {std::sin(azimuth) * std::cos(elevation), std::sin(elevation),
            -std::cos(azimuth) * std::cos(elevation)};
}

/// Both eyes at the head's origin: no parallax unless a test wants it.
StereoView centred_views(const Pose& head = {}) { return {square_view(head), square_view(head)}; }

StereoView views_of(const Pose& head, const PerEye<Pose>& in_head) {
    return {square_view(compose(head, in_head[kLeft])),
            square_view(compose(head, in_head[kRight]))};
}

time::Stamp at_ms(std::int64_t ms) { return {ms * kMs, time::StampKind::Modelled}; }

GazeSample invalid_sample(std::int64_t ms) {
    GazeSample sample;
    sample.sequence = static_cast<std::uint64_t>(ms);
    sample.device_ns = ms * kMs;
    sample.sampled = at_ms(ms);
    sample.arrived = at_ms(ms);
    return sample;
}

GazeSample sample_of(std::int64_t ms, const glm::dvec3& left, const glm::dvec3& right) {
    GazeSample sample = invalid_sample(ms);
    sample.eyes[kLeft].direction = left;
    sample.eyes[kLeft].valid = true;
    sample.eyes[kRight].direction = right;
    sample.eyes[kRight].valid = true;
    return sample;
}

GazeSample sample_of(std::int64_t ms, const glm::dvec3& direction) {
    return sample_of(ms, direction, direction);
}

double angle_deg(const glm::dvec3& a, const glm::dvec3& b) {
    return glm::degrees(std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)));
}

/// Held until 300 ms after the last valid sample, back at 500 ms.
FoveaPolicy policy() {
    return {.loss = {.stale_ns = 100 * kMs,
                     .hold_ns = 300 * kMs,
                     .return_ns = 200 * kMs,
                     .minimum_confidence = 0.6},
            .fixation_distance_m = 1.5};
}

FoveaPoint left_at(const GazeToFovea& gaze, std::int64_t ms, const Pose& head = {}) {
    return gaze.latch(at_ms(ms), head, centred_views(head)).eyes[kLeft];
}

void expect_state(const FoveaPoint& point, FoveaState state, LossReason reason) {
    EXPECT_EQ(kFoveaStateNames[static_cast<std::size_t>(point.state)],
              kFoveaStateNames[static_cast<std::size_t>(state)]);
    EXPECT_EQ(kLossReasonNames[static_cast<std::size_t>(point.reason)],
              kLossReasonNames[static_cast<std::size_t>(reason)]);
}

TEST(GazeToFovea, RestsInTheCentreWithoutAnySample) {
    const GazeToFovea gaze(policy());
    const FrameFovea frame = gaze.latch(at_ms(5), {}, centred_views());
    EXPECT_EQ(frame.latched, at_ms(5));
    for (const FoveaPoint& point : frame.eyes) {
        expect_state(point, FoveaState::Ahead, LossReason::Never);
        EXPECT_DOUBLE_EQ(point.position.x_px, 500.0);
        EXPECT_DOUBLE_EQ(point.position.y_px, 500.0);
        EXPECT_EQ(point.sample_sequence, 0U);
        EXPECT_FALSE(point.sampled.known());
        EXPECT_FALSE(point.arrived.known());
    }
}

TEST(GazeToFovea, NeverCountsInvalidSamplesAsGaze) {
    GazeToFovea gaze(policy());
    gaze.add(invalid_sample(0));
    gaze.add(invalid_sample(8));
    expect_state(left_at(gaze, 9), FoveaState::Ahead, LossReason::Never);
}

TEST(GazeToFovea, TracksEachEyeByItself) {
    GazeToFovea gaze(policy());
    GazeSample sample = sample_of(10, {0.1, 0.0, -1.0}, {-0.2, 0.3, -1.0});
    sample.arrived = at_ms(14);
    gaze.add(sample);
    const FrameFovea frame = gaze.latch(at_ms(15), {}, centred_views());
    expect_state(frame.eyes[kLeft], FoveaState::Tracking, LossReason::None);
    expect_state(frame.eyes[kRight], FoveaState::Tracking, LossReason::None);
    EXPECT_NEAR(frame.eyes[kLeft].position.x_px, 550.0, 1e-9);
    EXPECT_NEAR(frame.eyes[kLeft].position.y_px, 500.0, 1e-9);
    EXPECT_NEAR(frame.eyes[kRight].position.x_px, 400.0, 1e-9);
    EXPECT_NEAR(frame.eyes[kRight].position.y_px, 350.0, 1e-9);
    EXPECT_EQ(frame.eyes[kRight].sample_sequence, 10U);
    EXPECT_EQ(frame.eyes[kRight].sampled, at_ms(10));
    EXPECT_EQ(frame.eyes[kRight].arrived, at_ms(14));
    EXPECT_NEAR(glm::length(frame.eyes[kRight].direction), 1.0, 1e-15);
}

TEST(GazeToFovea, LendsTheOtherEyesDirection) {
    GazeToFovea gaze(policy());
    GazeSample sample = sample_of(10, {0.1, 0.0, -1.0}, {-0.2, 0.0, -1.0});
    sample.eyes[kLeft].valid = false;
    gaze.add(sample);
    const FrameFovea frame = gaze.latch(at_ms(15), {}, centred_views());
    expect_state(frame.eyes[kLeft], FoveaState::OtherEye, LossReason::None);
    expect_state(frame.eyes[kRight], FoveaState::Tracking, LossReason::None);
    EXPECT_NEAR(frame.eyes[kLeft].position.x_px, 400.0, 1e-9);

    // Lost afterwards, the borrowed direction is what is held.
    gaze.add(invalid_sample(20));
    const FoveaPoint held = left_at(gaze, 21);
    expect_state(held, FoveaState::Held, LossReason::Invalid);
    EXPECT_NEAR(held.position.x_px, 400.0, 1e-9);
}

TEST(GazeToFovea, BelievesOnlyConfidentFiniteDirections) {
    const auto is_taken = [](auto change) {
        GazeToFovea gaze(policy());
        GazeSample sample = invalid_sample(0);
        sample.eyes[kRight].valid = true;
        change(sample.eyes[kRight]);
        gaze.add(sample);
        return left_at(gaze, 1).state != FoveaState::Ahead;
    };
    EXPECT_TRUE(is_taken([](EyeRay&) {}));
    EXPECT_TRUE(is_taken([](EyeRay& ray) { ray.confidence = 0.6; }));
    EXPECT_TRUE(is_taken([](EyeRay& ray) { ray.confidence = -1.0; }));
    EXPECT_TRUE(is_taken([](EyeRay& ray) { ray.direction = {0.0, 1e-200, -1e-200}; }));
    EXPECT_FALSE(is_taken([](EyeRay& ray) { ray.confidence = 0.59; }));
    EXPECT_FALSE(is_taken([](EyeRay& ray) { ray.confidence = kNan; }));
    EXPECT_FALSE(is_taken([](EyeRay& ray) { ray.valid = false; }));
    EXPECT_FALSE(is_taken([](EyeRay& ray) { ray.direction = {0.0, 0.0, 0.0}; }));
    EXPECT_FALSE(is_taken([](EyeRay& ray) { ray.direction = {0.0, kNan, -1.0}; }));
    EXPECT_FALSE(
        is_taken([](EyeRay& ray) { ray.direction.z = -std::numeric_limits<double>::infinity(); }));
}

/// One valid sample, then invalid ones every 8 ms.
class Blink : public ::testing::Test {
  protected:
    Blink() : gaze_(policy()) { gaze_.add(sample_of(0, towards(30.0))); }

    FoveaPoint after_invalid_until(std::int64_t ms) {
        for (; next_ms_ <= ms; next_ms_ += 8) {
            gaze_.add(invalid_sample(next_ms_));
        }
        return left_at(gaze_, ms);
    }

    GazeToFovea gaze_;
    std::int64_t next_ms_ = 8;
};

TEST_F(Blink, GoesThroughEveryStateInTurn) {
    expect_state(after_invalid_until(0), FoveaState::Tracking, LossReason::None);
    expect_state(after_invalid_until(7), FoveaState::Tracking, LossReason::None);
    expect_state(after_invalid_until(8), FoveaState::Held, LossReason::Invalid);

    const FoveaPoint last_held = after_invalid_until(300);
    expect_state(last_held, FoveaState::Held, LossReason::Invalid);
    EXPECT_NEAR(angle_deg(last_held.direction, towards(30.0)), 0.0, 1e-9);
    EXPECT_EQ(last_held.sampled, at_ms(0));

    const FoveaPoint first_returning = after_invalid_until(301);
    expect_state(first_returning, FoveaState::Returning, LossReason::Invalid);
    EXPECT_LT(angle_deg(first_returning.direction, towards(30.0)), 0.01);

    // A quarter of the time: smooth step .15625; a half: one half.
    const FoveaPoint quarter = after_invalid_until(350);
    EXPECT_NEAR(angle_deg(quarter.direction, towards(30.0 * (1.0 - 0.15625))), 0.0, 1e-9);
    const FoveaPoint half = after_invalid_until(400);
    expect_state(half, FoveaState::Returning, LossReason::Invalid);
    EXPECT_NEAR(half.position.x_px, 500.0 + 500.0 * std::tan(glm::radians(15.0)), 1e-9);
    EXPECT_NEAR(half.position.y_px, 500.0, 1e-9);

    EXPECT_LT(angle_deg(after_invalid_until(499).direction, towards(0.0)), 0.01);
    const FoveaPoint centre = after_invalid_until(500);
    expect_state(centre, FoveaState::Ahead, LossReason::Invalid);
    EXPECT_DOUBLE_EQ(centre.position.x_px, 500.0);
    expect_state(after_invalid_until(60'000), FoveaState::Ahead, LossReason::Invalid);
}

TEST_F(Blink, EndsWithTheFirstValidSample) {
    expect_state(after_invalid_until(400), FoveaState::Returning, LossReason::Invalid);
    gaze_.add(sample_of(401, towards(-10.0)));
    const FoveaPoint point = left_at(gaze_, 402);
    expect_state(point, FoveaState::Tracking, LossReason::None);
    EXPECT_NEAR(angle_deg(point.direction, towards(-10.0)), 0.0, 1e-9);
}

TEST(GazeToFovea, GoesStaleWhenSamplesStop) {
    GazeToFovea gaze(policy());
    gaze.add(sample_of(50, towards(20.0)));
    expect_state(left_at(gaze, 150), FoveaState::Tracking, LossReason::None);
    expect_state(left_at(gaze, 151), FoveaState::Held, LossReason::Stale);
    expect_state(left_at(gaze, 350), FoveaState::Held, LossReason::Stale);
    expect_state(left_at(gaze, 351), FoveaState::Returning, LossReason::Stale);
    expect_state(left_at(gaze, 550), FoveaState::Ahead, LossReason::Stale);
}

TEST(GazeToFovea, SaysStaleWhenATrackerIsUnpluggedDuringABlink) {
    GazeToFovea gaze(policy());
    gaze.add(sample_of(0, towards(20.0)));
    gaze.add(invalid_sample(10));
    expect_state(left_at(gaze, 110), FoveaState::Held, LossReason::Invalid);
    expect_state(left_at(gaze, 111), FoveaState::Held, LossReason::Stale);
}

TEST(GazeToFovea, ReturnsAtOnceWhereThePolicyLeavesNoTime) {
    FoveaPolicy abrupt = policy();
    abrupt.loss.return_ns = 0;
    GazeToFovea gaze(abrupt);
    gaze.add(sample_of(0, towards(20.0)));
    expect_state(left_at(gaze, 300), FoveaState::Held, LossReason::Stale);
    expect_state(left_at(gaze, 301), FoveaState::Ahead, LossReason::Stale);
}

TEST(GazeToFovea, IgnoresWhatGoesBackInTime) {
    GazeToFovea gaze(policy());
    gaze.add(sample_of(20, towards(20.0)));
    GazeSample late = sample_of(10, towards(-20.0));
    gaze.add(late);
    EXPECT_EQ(left_at(gaze, 21).sample_sequence, 20U);

    // The same time is not back; an unknown sample time is not compared.
    gaze.add(sample_of(29, towards(20.0)));
    gaze.add(sample_of(29, towards(5.0)));
    GazeSample unknown = sample_of(30, towards(5.0));
    unknown.sampled = {};
    gaze.add(unknown);
    EXPECT_EQ(left_at(gaze, 31).sample_sequence, 30U);
}

TEST(GazeToFovea, TakesTheOrderOfArrivalWhereTheTrackersClockLies) {
    GazeToFovea gaze(policy());
    for (const std::int64_t ms : {0, 8, 16, 24}) {
        GazeSample sample = sample_of(ms, towards(20.0));
        sample.sampled = {};
        sample.device_ns = -ms * kMs;
        gaze.add(sample);
        EXPECT_EQ(left_at(gaze, ms + 1).sample_sequence, static_cast<std::uint64_t>(ms));
    }
}

TEST(GazeToFovea, DoesNotTakeAnIgnoredSampleForFreshOrInvalid) {
    GazeToFovea gaze(policy());
    gaze.add(sample_of(0, towards(20.0)));
    GazeSample back = invalid_sample(90);
    back.sampled = at_ms(-1);
    gaze.add(back);
    expect_state(left_at(gaze, 91), FoveaState::Tracking, LossReason::None);
    expect_state(left_at(gaze, 101), FoveaState::Held, LossReason::Stale);
}

TEST(GazeToFovea, LosesNothingWhenTheTrackersClockRestarts) {
    GazeToFovea gaze(policy());
    GazeSample sample = sample_of(100, towards(20.0));
    sample.device_ns = 1'000'000 * kMs;
    gaze.add(sample);
    sample = sample_of(108, towards(10.0));
    sample.device_ns = 0;
    gaze.add(sample);
    EXPECT_EQ(left_at(gaze, 109).sample_sequence, 108U);
}

TEST(GazeToFovea, RecoversFromASampleTimeFarInTheFuture) {
    GazeToFovea gaze(policy());
    GazeSample future = sample_of(0, towards(20.0));
    future.sampled = at_ms(3'600'000);
    gaze.add(future);
    // Its time says that it is fresh for an hour; that it arrived long ago says otherwise.
    expect_state(left_at(gaze, 100), FoveaState::Tracking, LossReason::None);
    expect_state(left_at(gaze, 101), FoveaState::Held, LossReason::Stale);
    gaze.add(sample_of(102, towards(0.0)));
    expect_state(left_at(gaze, 103), FoveaState::Held, LossReason::Stale);
    gaze.add(sample_of(110, towards(0.0)));
    EXPECT_EQ(left_at(gaze, 111).sample_sequence, 110U);
}

TEST(GazeToFovea, UsesASampleThatIsNewerThanTheLatch) {
    GazeToFovea gaze(policy());
    gaze.add(sample_of(1000, towards(20.0)));
    expect_state(left_at(gaze, 1), FoveaState::Tracking, LossReason::None);
}

TEST(GazeToFovea, TakesASampleOfUnknownAgeForTooOld) {
    GazeToFovea gaze(policy());
    GazeSample sample = sample_of(0, towards(20.0));
    sample.sampled = {};
    sample.arrived = {};
    gaze.add(sample);
    expect_state(left_at(gaze, 0), FoveaState::Ahead, LossReason::Stale);

    GazeSample arrived = sample_of(10, towards(20.0));
    arrived.sampled = {};
    gaze.add(arrived);
    expect_state(left_at(gaze, 20), FoveaState::Tracking, LossReason::None);
    EXPECT_FALSE(left_at(gaze, 20).sampled.known());
}

TEST(GazeToFovea, SurvivesExtremeTimes) {
    constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
    GazeToFovea gaze(policy());
    GazeSample sample = sample_of(0, towards(20.0));
    sample.device_ns = kMin;
    sample.sampled.ns = kMin;
    sample.arrived.ns = kMin;
    gaze.add(sample);
    const FrameFovea late = gaze.latch({kMax, time::StampKind::Modelled}, {}, centred_views());
    expect_state(late.eyes[kLeft], FoveaState::Ahead, LossReason::Stale);
    const FrameFovea now = gaze.latch({kMin, time::StampKind::Modelled}, {}, centred_views());
    expect_state(now.eyes[kLeft], FoveaState::Tracking, LossReason::None);
}

// ---- Where the point is seen --------------------------------------------------------------------

TEST(GazeToFovea, GivesTheDirectionBackWhileTheHeadRests) {
    // Eyes apart and canted, the head anywhere: the direction in the view is the one in the head,
    // turned by the cant, whatever the distance.
    const PerEye<Pose> in_head{Pose{yaw(6.0), {-0.032, 0.01, -0.02}},
                               Pose{yaw(-6.0), {0.032, 0.01, -0.02}}};
    const Pose head{glm::normalize(glm::dquat{0.3, -0.5, 0.2, 0.7}), {120.0, -3.0, 45.0}};
    for (const double distance_m : {0.1, 1.5, 1000.0}) {
        FoveaPolicy at_distance = policy();
        at_distance.fixation_distance_m = distance_m;
        GazeToFovea gaze(at_distance);
        GazeSample sample = sample_of(0, towards(11.0, -7.0), towards(8.0, -6.5));
        sample.head = head;
        gaze.add(sample);
        const FrameFovea frame = gaze.latch(at_ms(5), head, views_of(head, in_head));
        for (const Eye eye : kEyes) {
            const std::size_t i = index(eye);
            const glm::dvec3 expected =
                glm::conjugate(in_head[i].orientation) * sample.eyes[i].direction;
            EXPECT_LT(glm::length(frame.eyes[i].direction - expected), 1e-13 / distance_m + 1e-14)
                << kEyeNames[i] << " at " << distance_m << " m";
        }
    }
}

TEST(GazeToFovea, FollowsTheWorldWhileTheHeadTurns) {
    // Looking straight ahead from the origin; then the head turns 10 deg to the left, and what was
    // looked at is 10 deg to the right: 500 + 500 tan(10 deg).
    GazeToFovea gaze(policy());
    GazeSample sample = sample_of(0, towards(0.0));
    sample.head = Pose{};
    gaze.add(sample);
    const FoveaPoint point = left_at(gaze, 20, Pose{yaw(10.0), {}});
    EXPECT_NEAR(point.position.x_px, 588.1634904, 1e-6);
    EXPECT_NEAR(point.position.y_px, 500.0, 1e-9);
}

TEST(GazeToFovea, CountsTheEyesOwnMotionWhileTheHeadTurns) {
    // The right eye at (.03, 0, 0) looks at (.03, 0, -1.5). In the head turned by 10 deg to the
    // left that point is at (.03 cos + 1.5 sin, 0, .03 sin - 1.5 cos) = (.290016499, 0,
    // -1.472002184), from the eye (.260016499, 0, -1.472002184): tangent .176641381.
    GazeToFovea gaze(policy());
    GazeSample sample = sample_of(0, towards(0.0));
    sample.head = Pose{};
    gaze.add(sample);
    const Pose turned{yaw(10.0), {}};
    const PerEye<Pose> in_head{Pose{{1.0, 0.0, 0.0, 0.0}, {-0.03, 0.0, 0.0}},
                               Pose{{1.0, 0.0, 0.0, 0.0}, {0.03, 0.0, 0.0}}};
    const FrameFovea frame = gaze.latch(at_ms(20), turned, views_of(turned, in_head));
    EXPECT_NEAR(frame.eyes[kRight].position.x_px, 588.3206906, 1e-6);
    EXPECT_NEAR(frame.eyes[kRight].position.y_px, 500.0, 1e-9);
}

TEST(GazeToFovea, CountsTheHeadsTranslationAtTheFixationDistance) {
    // .1 m to the right at 1.5 m: tangent -1/15; .15 m forward leaves straight ahead where it is.
    GazeToFovea gaze(policy());
    GazeSample sample = sample_of(0, towards(0.0));
    sample.head = Pose{};
    gaze.add(sample);
    EXPECT_NEAR(left_at(gaze, 20, Pose{{1.0, 0.0, 0.0, 0.0}, {0.1, 0.0, 0.0}}).position.x_px,
                500.0 - 500.0 / 15.0, 1e-9);
    EXPECT_NEAR(left_at(gaze, 20, Pose{{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, -0.15}}).position.x_px,
                500.0, 1e-9);
}

TEST(GazeToFovea, HoldsTheWorldPointThroughABlink) {
    GazeToFovea gaze(policy());
    GazeSample sample = sample_of(0, towards(0.0));
    sample.head = Pose{};
    gaze.add(sample);
    gaze.add(invalid_sample(199));
    const FoveaPoint held = left_at(gaze, 200, Pose{yaw(-10.0), {}});
    expect_state(held, FoveaState::Held, LossReason::Invalid);
    EXPECT_NEAR(held.position.x_px, 500.0 - 88.1634904, 1e-6);

    // On the way back it is interpolated from where the held point is seen now.
    gaze.add(invalid_sample(400));
    const FoveaPoint half = left_at(gaze, 400, Pose{yaw(-10.0), {}});
    EXPECT_NEAR(angle_deg(half.direction, towards(-5.0)), 0.0, 1e-9);
}

TEST(GazeToFovea, KeepsItsPlaceWhereTheOriginMoves) {
    const Pose head{yaw(20.0), {0.5, 1.6, 0.0}};
    const Pose new_in_old{yaw(90.0), {3.0, 0.0, -1.0}};
    const Pose same_head = compose(inverse(new_in_old), head);
    // Tracking, held in a blink, on the way back, and held in the head.
    for (const std::int64_t ms : {20, 200, 400}) {
        for (const bool posed : {true, false}) {
            GazeToFovea gaze(policy());
            GazeSample sample = sample_of(0, towards(15.0, -4.0));
            sample.head = posed ? std::optional(head) : std::nullopt;
            gaze.add(sample);
            gaze.add(invalid_sample(ms));
            const FoveaPoint before = left_at(gaze, ms, head);
            gaze.move_origin(new_in_old);
            const FoveaPoint after = left_at(gaze, ms, same_head);
            EXPECT_NEAR(angle_deg(after.direction, before.direction), 0.0, 1e-9) << ms;
            EXPECT_EQ(after.state, before.state);
            // And it is held in the new world: the head turns 5 deg, what is held the other way.
            const Pose turned{same_head.orientation * yaw(-5.0), same_head.position_m};
            GazeToFovea unmoved(policy());
            unmoved.add(sample);
            unmoved.add(invalid_sample(ms));
            EXPECT_NEAR(angle_deg(left_at(gaze, ms, turned).direction,
                                  left_at(unmoved, ms, compose(new_in_old, turned)).direction),
                        0.0, 1e-9);
        }
    }
}

TEST(GazeToFovea, HasNothingToMoveBeforeTheFirstGaze) {
    GazeToFovea gaze(policy());
    gaze.move_origin({yaw(90.0), {}});
    expect_state(left_at(gaze, 1), FoveaState::Ahead, LossReason::Never);
    GazeSample sample = sample_of(2, towards(15.0));
    sample.head = Pose{};
    gaze.add(sample);
    EXPECT_NEAR(angle_deg(left_at(gaze, 3).direction, towards(15.0)), 0.0, 1e-9);
}

TEST(GazeToFovea, HoldsInTheHeadWhereTheSampleHasNoUsablePose) {
    const Pose head{yaw(35.0), {3.0, 1.6, -2.0}};
    const std::array<std::optional<Pose>, 4> unusable{
        std::nullopt, Pose{{1.0, 0.0, 0.0, 0.0}, {0.0, kNan, 0.0}},
        Pose{{kNan, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}, Pose{{0.0, 0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}};
    for (const std::optional<Pose>& pose : unusable) {
        GazeToFovea gaze(policy());
        GazeSample sample = sample_of(0, towards(12.0, 3.0));
        sample.head = pose;
        gaze.add(sample);
        EXPECT_NEAR(angle_deg(left_at(gaze, 20, head).direction, towards(12.0, 3.0)), 0.0, 1e-9);
    }
}

TEST(GazeToFovea, ReturnsToStraightAheadOfTheHeadInCantedViews) {
    // The left view is turned outwards by 8 deg: straight ahead is 8 deg to its right.
    const PerEye<Pose> in_head{Pose{yaw(8.0), {-0.03, 0.0, 0.0}},
                               Pose{yaw(-8.0), {0.03, 0.0, 0.0}}};
    const Pose head{yaw(77.0), {1.0, 2.0, 3.0}};
    GazeToFovea gaze(policy());
    GazeSample sample = sample_of(0, towards(20.0));
    sample.head = head;
    gaze.add(sample);
    const FrameFovea centre = gaze.latch(at_ms(600), head, views_of(head, in_head));
    expect_state(centre.eyes[kLeft], FoveaState::Ahead, LossReason::Stale);
    EXPECT_NEAR(angle_deg(centre.eyes[kLeft].direction, towards(8.0)), 0.0, 1e-9);
    EXPECT_NEAR(angle_deg(centre.eyes[kRight].direction, towards(-8.0)), 0.0, 1e-9);
    const FrameFovea half = gaze.latch(at_ms(400), head, views_of(head, in_head));
    EXPECT_NEAR(angle_deg(half.eyes[kLeft].direction, towards(18.0)), 0.0, 1e-9);
}

TEST(GazeToFovea, ReturnsFromStraightBehindWithoutLosingItsWay) {
    GazeToFovea gaze(policy());
    gaze.add(sample_of(0, {0.0, 0.0, 1.0}));
    for (std::int64_t ms = 300; ms <= 500; ++ms) {
        const FoveaPoint point = left_at(gaze, ms);
        EXPECT_NEAR(glm::length(point.direction), 1.0, 1e-12) << ms;
        EXPECT_TRUE(std::isfinite(point.position.x_px) && std::isfinite(point.position.y_px));
    }
    EXPECT_NEAR(angle_deg(left_at(gaze, 400).direction, towards(0.0)), 90.0, 1e-9);
}

TEST(GazeToFovea, StaysFiniteWhereTheEyeArrivesAtTheFixatedPoint) {
    GazeToFovea gaze(policy());
    GazeSample sample = sample_of(0, towards(0.0));
    sample.head = Pose{};
    gaze.add(sample);
    const FoveaPoint point = left_at(gaze, 10, Pose{{1.0, 0.0, 0.0, 0.0}, {0.0, 0.0, -1.5}});
    EXPECT_NEAR(glm::length(point.direction), 1.0, 1e-12);
}

// ---- Determinism --------------------------------------------------------------------------------

std::vector<std::uint64_t> bits_of_a_run() {
    GazeToFovea gaze(policy());
    std::vector<std::uint64_t> bits;
    const PerEye<Pose> in_head{Pose{yaw(3.0), {-0.03, 0.0, 0.0}},
                               Pose{yaw(-3.0), {0.03, 0.0, 0.0}}};
    for (std::int64_t ms = 0; ms < 1500; ms += 8) {
        const double t = static_cast<double>(ms);
        GazeSample sample = sample_of(ms, towards(10.0 * std::sin(t / 90.0), t / 100.0));
        const bool blinking = ms > 400 && ms < 1000;
        sample.eyes[kLeft].valid = !blinking;
        sample.eyes[kRight].valid = !blinking && ms % 48 != 0;
        sample.head = Pose{yaw(t / 50.0), {t * 1e-4, 0.0, 0.0}};
        gaze.add(sample);
        const Pose head{yaw((t + 11.0) / 50.0), {t * 1e-4, 0.001, 0.0}};
        const FrameFovea frame = gaze.latch(at_ms(ms + 5), head, views_of(head, in_head));
        for (const FoveaPoint& point : frame.eyes) {
            for (const double value : {point.position.x_px, point.position.y_px, point.direction.x,
                                       point.direction.y, point.direction.z}) {
                bits.push_back(std::bit_cast<std::uint64_t>(value));
            }
            bits.push_back(static_cast<std::uint64_t>(point.state));
        }
    }
    return bits;
}

TEST(GazeToFovea, RepeatsItselfBitForBit) { EXPECT_EQ(bits_of_a_run(), bits_of_a_run()); }

TEST(GazeToFovea, IsNotChangedByLatching) {
    // A latch reads; it leaves nothing behind for the next one.
    GazeToFovea asked_often(policy());
    GazeToFovea asked_once(policy());
    for (std::int64_t ms = 0; ms < 200; ms += 8) {
        asked_often.add(sample_of(ms, towards(static_cast<double>(ms) / 20.0)));
        asked_once.add(sample_of(ms, towards(static_cast<double>(ms) / 20.0)));
        (void)left_at(asked_often, ms + 400);
        (void)left_at(asked_often, ms);
    }
    EXPECT_EQ(left_at(asked_often, 201).position.x_px, left_at(asked_once, 201).position.x_px);
}

}  // namespace
}  // namespace gazeloop::gaze
