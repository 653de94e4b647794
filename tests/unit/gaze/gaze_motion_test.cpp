#include "runtime/gaze/gaze_motion.h"

#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <optional>

#include "runtime/gaze/gaze_to_fovea.h"
#include "runtime/gaze/main_sequence.h"

namespace gazeloop::gaze {
namespace {

constexpr std::int64_t kInterval_ns = 4'000'000;
constexpr double kInterval_s = 0.004;

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

glm::dquat yaw_left(double degrees) {
    return glm::angleAxis(glm::radians(degrees), glm::dvec3{0.0, 1.0, 0.0});
}

glm::dvec3 right_by(double deg) {
    return {std::sin(glm::radians(deg)), 0.0, -std::cos(glm::radians(deg))};
}

double right_deg(const glm::dvec3& direction) {
    return glm::degrees(std::atan2(direction.x, -direction.z));
}

time::Stamp at(std::int64_t ns) { return {ns, time::StampKind::Modelled}; }

GazeSample sample_at(std::int64_t ns, double left_deg, double right_eye_deg,
                     const std::optional<Pose>& head = {}) {
    GazeSample sample;
    sample.sequence = static_cast<std::uint64_t>(ns / kInterval_ns);
    sample.sampled = at(ns);
    sample.arrived = at(ns);
    sample.eyes[0] = {.direction = right_by(left_deg), .valid = true};
    sample.eyes[1] = {.direction = right_by(right_eye_deg), .valid = true};
    sample.head = head;
    return sample;
}

FoveaPolicy far_away(const MotionPolicy& motion) {
    FoveaPolicy policy;
    policy.fixation_distance_m = 1000.0;
    policy.motion = motion;
    return policy;
}

/// A saccade of 12 deg, seen until shortly before its middle.
class SaccadeUnderWay {
  public:
    explicit SaccadeUnderWay(const MotionPolicy& motion) : gaze(far_away(motion)) {
        for (; now_ns < 400'000'000; now_ns += kInterval_ns) {
            gaze.add(sample_at(now_ns, -5.0, -5.0));
        }
        const SaccadeCourse course(12.0, 1.0);
        for (double t = kInterval_s; t < 0.45 * course.duration_s(); t += kInterval_s) {
            seen_deg = -5.0 + 12.0 * course.progress(t);
            shown_deg = -5.0 + 12.0 * course.progress(t + 0.015);
            gaze.add(sample_at(now_ns, seen_deg, seen_deg));
            now_ns += kInterval_ns;
        }
    }
    [[nodiscard]] FoveaPoint left(bool shown_known = true) const {
        const time::Stamp shown =
            shown_known ? at(now_ns - kInterval_ns + 15'000'000) : time::Stamp{};
        return gaze.latch(at(now_ns), {}, {square_view(), square_view()}, shown).eyes[0];
    }

    GazeToFovea gaze;
    std::int64_t now_ns = 0;
    double seen_deg = 0.0;
    double shown_deg = 0.0;
};

TEST(GazeMotion, IsOffByDefault) {
    const SaccadeUnderWay under_way({});
    const FoveaPoint point = under_way.left();
    EXPECT_NEAR(right_deg(point.direction), under_way.seen_deg, 1e-9);
    EXPECT_FALSE(point.event.has_value());
    EXPECT_FALSE(point.horizon_ns.has_value());
    EXPECT_FALSE(point.uncertainty_rad.has_value());
    EXPECT_FALSE(point.filter_delay_ns.has_value());
}

TEST(GazeMotion, TellsEventsAndLeavesTheFoveaAlone) {
    const SaccadeUnderWay under_way({.tell_events = true});
    const FoveaPoint point = under_way.left();
    EXPECT_EQ(point.event, EyeEvent::Saccade);
    EXPECT_FALSE(point.horizon_ns.has_value());
    const FoveaPoint plain = SaccadeUnderWay({}).left();
    EXPECT_EQ(point.direction, plain.direction);
    EXPECT_EQ(point.position.x_px, plain.position.x_px);
}

TEST(GazeMotion, PredictsTheFoveaToWhenItIsShown) {
    const SaccadeUnderWay under_way({.predict = true});
    const FoveaPoint point = under_way.left();
    EXPECT_EQ(point.event, EyeEvent::Saccade);
    EXPECT_EQ(point.horizon_ns, 15'000'000);
    ASSERT_TRUE(point.uncertainty_rad.has_value());
    const double held_off = under_way.shown_deg - under_way.seen_deg;
    EXPECT_LT(std::abs(under_way.shown_deg - right_deg(point.direction)), 0.75 * held_off);
    EXPECT_EQ(point.state, FoveaState::Tracking);
    // The same samples give the same bits.
    const FoveaPoint again = SaccadeUnderWay({.predict = true}).left();
    EXPECT_EQ(std::bit_cast<std::uint64_t>(again.direction.x),
              std::bit_cast<std::uint64_t>(point.direction.x));
    // Nobody knows when it is shown: nothing is predicted.
    const FoveaPoint unknown = under_way.left(false);
    EXPECT_FALSE(unknown.horizon_ns.has_value());
    EXPECT_NEAR(right_deg(unknown.direction), under_way.seen_deg, 1e-9);
}

TEST(GazeMotion, TakesNoHeadTurnForASaccade) {
    // The head turns at 120 deg/s, the eyes stay on a point in the world.
    GazeToFovea gaze(far_away({.predict = true}));
    std::int64_t now_ns = 0;
    double turned_deg = 0.0;
    for (int i = 0; i < 200; ++i, now_ns += kInterval_ns) {
        turned_deg = i < 100 ? 0.0 : 120.0 * (i - 100) * kInterval_s;
        gaze.add(sample_at(now_ns, turned_deg, turned_deg, Pose{yaw_left(turned_deg), {}}));
    }
    const Pose head{yaw_left(turned_deg + 2.0), {}};
    const FoveaPoint point = gaze.latch(at(now_ns), head, {square_view(head), square_view(head)},
                                        at(now_ns + 16'000'000))
                                 .eyes[0];
    EXPECT_EQ(point.event, EyeEvent::Fixation);
    EXPECT_NEAR(right_deg(point.direction), turned_deg + 2.0, 1e-6);
}

TEST(GazeMotion, TakesALostEyeForNoMovement) {
    // The eyes converge by 8 deg; then the right one is lost.
    GazeToFovea gaze(far_away({.predict = true}));
    std::int64_t now_ns = 0;
    for (int i = 0; i < 200; ++i, now_ns += kInterval_ns) {
        GazeSample sample = sample_at(now_ns, 4.0, -4.0);
        sample.eyes[1].valid = i < 100;
        gaze.add(sample);
        const FoveaPoint point =
            gaze.latch(at(now_ns), {}, {square_view(), square_view()}, at(now_ns + 16'000'000))
                .eyes[0];
        if (i > 2) {
            EXPECT_EQ(point.event, EyeEvent::Fixation) << i;
        }
        EXPECT_NEAR(right_deg(point.direction), 4.0, 1e-6) << i;
    }
}

TEST(GazeMotion, StatesTheFiltersDelayOfEachEye) {
    for (const GazeFilter filter : {GazeFilter::OneEuro, GazeFilter::Fixation}) {
        GazeToFovea gaze(far_away({.filter = filter}));
        std::int64_t now_ns = 0;
        for (int i = 0; i < 250; ++i, now_ns += kInterval_ns) {
            GazeSample sample = sample_at(now_ns, i % 2 == 0 ? 0.05 : -0.05, 1.0);
            sample.eyes[1].valid = i != 249;
            gaze.add(sample);
        }
        const FrameFovea frame = gaze.latch(at(now_ns), {}, {square_view(), square_view()});
        EXPECT_GT(frame.eyes[0].filter_delay_ns.value_or(0), 5'000'000);
        EXPECT_LT(std::abs(right_deg(frame.eyes[0].direction)), 0.03);
        // The right eye is lost: it has the left one's direction, and its delay.
        EXPECT_EQ(frame.eyes[1].state, FoveaState::OtherEye);
        EXPECT_EQ(frame.eyes[1].filter_delay_ns, frame.eyes[0].filter_delay_ns);
    }
}

TEST(GazeMotion, PredictsNothingThatIsHeld) {
    SaccadeUnderWay under_way({.predict = true});
    GazeSample lost;
    lost.sampled = at(under_way.now_ns);
    lost.arrived = lost.sampled;
    under_way.gaze.add(lost);
    const FoveaPoint point = under_way.left();
    EXPECT_EQ(point.state, FoveaState::Held);
    EXPECT_EQ(point.event, EyeEvent::Lost);
    EXPECT_FALSE(point.horizon_ns.has_value());
    EXPECT_NEAR(right_deg(point.direction), under_way.seen_deg, 1e-9);
}

TEST(GazeMotion, LosesWhatTheLossMachineDoesNotLetThrough) {
    FoveaPolicy policy = far_away({.filter = GazeFilter::OneEuro, .predict = true});
    policy.loss.closed_below = 0.5;
    policy.loss.reopen_ns = 5 * kInterval_ns;
    GazeToFovea gaze(policy);
    const auto look = [&](int i, double deg, float openness) {
        GazeSample sample = sample_at(i * kInterval_ns, deg, deg);
        sample.eyes[0].openness = sample.eyes[1].openness = openness;
        gaze.add(sample);
        const time::Stamp now = at(i * kInterval_ns);
        return gaze.latch(now, {}, {square_view(), square_view()}, now).eyes[0];
    };
    int i = 0;
    for (; i < 100; ++i) {
        EXPECT_NEAR(right_deg(look(i, 2.0, 1.0F).direction), 2.0, 1e-6);
    }
    const FoveaPoint shut = look(i++, 2.0, 0.0F);
    EXPECT_EQ(shut.cause, LossCause::Blink);
    EXPECT_EQ(shut.event, EyeEvent::Lost);
    // The lids open: directions come, but nobody trusts them, so that they are no saccade either.
    for (int opening = 0; opening < 5; ++opening) {
        const FoveaPoint point = look(i++, 12.0, 1.0F);
        EXPECT_EQ(point.state, FoveaState::Held);
        EXPECT_EQ(point.event, EyeEvent::Lost);
        EXPECT_FALSE(point.horizon_ns.has_value());
        EXPECT_NEAR(right_deg(point.direction), 2.0, 1e-6);
    }
    // The filter starts anew: it has nothing of before.
    const FoveaPoint open = look(i++, 7.0, 1.0F);
    EXPECT_EQ(open.state, FoveaState::Tracking);
    EXPECT_NE(open.event, EyeEvent::Saccade);
    EXPECT_NEAR(right_deg(open.direction), 7.0, 1e-6);
}

TEST(GazeMotion, StatesItsOwnUncertaintyUnlessTheFoveaIsWidened) {
    const auto shown = [](const FoveaPolicy& policy) {
        GazeToFovea gaze(policy);
        for (int i = 0; i < 100; ++i) {
            gaze.add(sample_at(i * kInterval_ns, 1.0, 1.0, Pose{}));
        }
        return gaze
            .latch(at(99 * kInterval_ns), {}, {square_view(), square_view()},
                   at(99 * kInterval_ns + 20'000'000))
            .eyes[0];
    };
    FoveaPolicy policy = far_away({.predict = true});
    const FoveaPoint predicted = shown(policy);
    ASSERT_TRUE(predicted.uncertainty_rad.has_value());
    EXPECT_FALSE(predicted.widens);
    policy.uncertainty = UncertaintyPolicy{};
    const FoveaPoint both = shown(policy);
    EXPECT_TRUE(both.widens);
    // 2.6 x .5 + 1.96 x .2; all of the latency is predicted.
    EXPECT_NEAR(glm::degrees(both.uncertainty_rad.value()),
                1.3 + 0.392 + glm::degrees(*predicted.uncertainty_rad), 1e-9);
    EXPECT_EQ(both.direction, predicted.direction);
    policy.motion.predict = false;
    EXPECT_NEAR(glm::degrees(shown(policy).uncertainty_rad.value()), 1.3 + 0.392 + 0.2, 1e-9);
    policy.motion.filter = GazeFilter::OneEuro;
    const FoveaPoint filtered = shown(policy);
    const double delay_s = 1e-9 * static_cast<double>(filtered.filter_delay_ns.value());
    EXPECT_GT(delay_s, 0.005);
    EXPECT_NEAR(glm::degrees(filtered.uncertainty_rad.value()),
                1.3 + 0.392 + 10.0 * (0.02 + delay_s), 1e-9);
}

TEST(GazeMotion, GoesAlongWhenTheOriginMoves) {
    GazeToFovea gaze(far_away({.predict = true}));
    GazeToFovea moved(far_away({.predict = true}));
    const Pose new_in_old{yaw_left(50.0), {1.0, 0.0, 2.0}};
    std::int64_t now_ns = 0;
    for (int i = 0; i < 300; ++i, now_ns += kInterval_ns) {
        const double deg = 15.0 * i * kInterval_s - 9.0;  // a pursuit
        const Pose head{yaw_left(10.0), {}};
        gaze.add(sample_at(now_ns, deg, deg, head));
        if (i == 290) {
            moved.move_origin(new_in_old);
        }
        const Pose new_head = i < 290 ? head : compose(inverse(new_in_old), head);
        moved.add(sample_at(now_ns, deg, deg, new_head));
    }
    const Pose head{yaw_left(10.0), {}};
    const Pose new_head = compose(inverse(new_in_old), head);
    const auto shown = at(now_ns + 30'000'000);
    const FoveaPoint expected =
        gaze.latch(at(now_ns), head, {square_view(head), square_view(head)}, shown).eyes[0];
    const FoveaPoint point =
        moved.latch(at(now_ns), new_head, {square_view(new_head), square_view(new_head)}, shown)
            .eyes[0];
    EXPECT_EQ(expected.event, EyeEvent::Pursuit);
    EXPECT_EQ(point.event, EyeEvent::Pursuit);
    EXPECT_GT(right_deg(point.direction), 15.0 * 299 * kInterval_s - 9.0 + 0.1);
    EXPECT_NEAR(right_deg(point.direction), right_deg(expected.direction), 1e-6);
}

TEST(GazeMotion, StandsHeadsThatComeAndGo) {
    GazeToFovea gaze(far_away({.filter = GazeFilter::OneEuro, .predict = true}));
    for (int i = 0; i < 300; ++i) {
        const std::optional<Pose> head =
            i / 10 % 2 == 0 ? std::optional(Pose{yaw_left(40.0), {}}) : std::nullopt;
        gaze.add(sample_at(i * kInterval_ns, 1.0, 1.0, head));
        const FoveaPoint point = gaze.latch(at(i * kInterval_ns), Pose{yaw_left(40.0), {}},
                                            {square_view(Pose{yaw_left(40.0), {}}), square_view()},
                                            at(i * kInterval_ns + 1'000'000'000))
                                     .eyes[0];
        EXPECT_NEAR(right_deg(point.direction), 1.0, 1e-6) << i;
        EXPECT_NE(point.event, EyeEvent::Saccade) << i;
    }
}

}  // namespace
}  // namespace gazeloop::gaze
