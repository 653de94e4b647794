#include "runtime/gaze/origin_watch.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/trigonometric.hpp>
#include <limits>
#include <optional>

#include "runtime/gaze/head_limits.h"

namespace gazeloop::gaze {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kPeriod_ns = 10 * kMs;  // a head turns by at most 15 degrees in it

Pose yawed(double degrees, const glm::dvec3& position_m = {}) {
    return {glm::angleAxis(glm::radians(degrees), glm::dvec3{0.0, 1.0, 0.0}), position_m};
}

void expect_same(const Pose& actual, const Pose& expected) {
    EXPECT_NEAR(glm::degrees(turned_rad(actual, expected)), 0.0, 1e-6);
    EXPECT_NEAR(moved_m(actual, expected), 0.0, 1e-9);
}

class Origin : public ::testing::Test {
  protected:
    /// The next frame's head, a period after the last one.
    std::optional<OriginChange> frame(const Pose& head) {
        now_ns += kPeriod_ns;
        return watch.next(now_ns, kPeriod_ns, head);
    }
    /// At a head that turns evenly, from 0 on.
    void frames(int count, double degrees_each = 0.0) {
        for (int i = 0; i < count; ++i) {
            EXPECT_FALSE(frame(yawed(yaw))) << i;
            yaw += degrees_each;
        }
    }

    OriginWatch watch;
    std::int64_t now_ns = 0;
    double yaw = 0.0;
};

TEST_F(Origin, StaysWhileAHeadMoves) {
    frames(50, 5.0);  // 500 deg/s
    EXPECT_FALSE(frame(yawed(yaw + 8.0, {0.0, 0.045, 0.0})));
}

TEST_F(Origin, HasMovedWhereNoHeadDoes) {
    frames(10);
    const auto change = frame(yawed(16.0));
    ASSERT_TRUE(change);
    EXPECT_FALSE(change->announced);
    // A head that stood still.
    expect_same(carried(change->new_in_old, yawed(0.0)), yawed(16.0));
    EXPECT_FALSE(frame(yawed(17.0)));
    const auto moved = frame(yawed(17.0, {0.0, -0.06, 0.0}));
    ASSERT_TRUE(moved);
    expect_same(moved->new_in_old, {yawed(0.0).orientation, {0.0, 0.06, 0.0}});
}

TEST_F(Origin, MayMoveTwiceInARow) {
    frames(10);
    ASSERT_TRUE(frame(yawed(90.0)));
    const auto back = frame(yawed(0.0));
    ASSERT_TRUE(back);
    expect_same(back->new_in_old, yawed(90.0));
    EXPECT_FALSE(frame(yawed(0.0)));
}

TEST_F(Origin, IsWhereTheRuntimeSaysFromItsTimeOn) {
    frames(10, 1.0);
    watch.announce({now_ns + 15 * kMs, yawed(30.0, {1.0, 0.0, 0.0})});
    EXPECT_FALSE(frame(yawed(10.0)));
    const auto change = frame(carried(yawed(30.0, {1.0, 0.0, 0.0}), yawed(11.0)));
    ASSERT_TRUE(change);
    EXPECT_TRUE(change->announced);
    expect_same(change->new_in_old, yawed(30.0, {1.0, 0.0, 0.0}));
    EXPECT_FALSE(frame(carried(yawed(30.0, {1.0, 0.0, 0.0}), yawed(12.0))));
    EXPECT_EQ(watch.take_given_up(), 0U);
}

TEST_F(Origin, IsBelievedWhereItIsTooSmallToSee) {
    frames(10);
    watch.announce({now_ns + 1, yawed(3.0)});
    const auto change = frame(yawed(0.5));  // a head that turned by 3.5, or was not carried
    ASSERT_TRUE(change);
    expect_same(change->new_in_old, yawed(3.0));
}

TEST_F(Origin, ThatMovesBeforeOrAfterItsTimeMovesOnce) {
    for (const int late_frames : {-2, 3}) {
        SCOPED_TRACE(late_frames);
        watch = {};
        frames(10);
        watch.announce({now_ns + 3 * kPeriod_ns, yawed(90.0)});
        frames(2 + late_frames);
        const auto change = frame(yawed(-90.0));
        ASSERT_TRUE(change);
        EXPECT_TRUE(change->announced);
        expect_same(change->new_in_old, yawed(90.0));
        for (int i = 0; i < 150; ++i) {
            EXPECT_FALSE(frame(yawed(-90.0)));
        }
        EXPECT_EQ(watch.take_given_up(), 0U);
    }
}

TEST_F(Origin, ThatNeverMovesIsGivenUp) {
    frames(10);
    watch.announce({now_ns, yawed(90.0)});
    frames(105);
    EXPECT_EQ(watch.take_given_up(), 1U);
    EXPECT_EQ(watch.take_given_up(), 0U);
}

TEST_F(Origin, IsWhereAStillHeadPutsItIfTheRuntimeDoesNotSay) {
    frames(10);
    watch.announce({now_ns + 5 * kMs, std::nullopt});
    const auto change = frame(yawed(4.0));  // as a head might do
    ASSERT_TRUE(change);
    EXPECT_FALSE(change->announced);
    expect_same(change->new_in_old, yawed(-4.0));
}

TEST_F(Origin, ThatIsNotWhereTheRuntimeSaysIsWhereTheHeadShowsIt) {
    frames(10);
    watch.announce({now_ns + 1, yawed(90.0)});
    const auto change = frame(yawed(45.0));
    ASSERT_TRUE(change);
    EXPECT_FALSE(change->announced);
    expect_same(carried(change->new_in_old, yawed(0.0)), yawed(45.0));
}

TEST_F(Origin, OfTheFirstFrameIsTheFirst) {
    watch.announce({0, yawed(90.0)});
    EXPECT_FALSE(frame(yawed(0.0)));
    EXPECT_FALSE(frame(yawed(0.0)));
}

TEST_F(Origin, IsJudgedByThePeriodWhereAnnouncedTimesStandOrGoBack) {
    frames(10);
    EXPECT_FALSE(watch.next(now_ns, kPeriod_ns, yawed(14.0)));
    EXPECT_FALSE(watch.next(now_ns - 100 * kMs, kPeriod_ns, yawed(28.0)));
    EXPECT_TRUE(watch.next(now_ns - 100 * kMs, kPeriod_ns, yawed(44.0)));
    // 5 ms where the runtime knows no period.
    EXPECT_FALSE(watch.next(now_ns - 100 * kMs, 0, yawed(51.0)));
    EXPECT_TRUE(watch.next(now_ns - 100 * kMs, 0, yawed(59.0)));
}

TEST_F(Origin, StaysWhereAnnouncedTimesStepForthAndBack) {
    frames(10);
    EXPECT_FALSE(watch.next(now_ns + 1000 * kMs, kPeriod_ns, yawed(120.0)));
    EXPECT_FALSE(frame(yawed(0.0)));
    EXPECT_FALSE(watch.next(now_ns - 1000 * kMs, kPeriod_ns, yawed(-120.0)));
    EXPECT_FALSE(frame(yawed(0.0)));
    // Nor does a period that is none hide what no head does.
    now_ns += kPeriod_ns;
    EXPECT_TRUE(watch.next(now_ns, 1000 * kMs, yawed(90.0)));
}

TEST_F(Origin, TakesSamplesHeadsFromEitherWorld) {
    frames(10, 1.0);
    const std::int64_t before_ns = now_ns - 5 * kMs;
    const Pose then = yawed(8.5);
    expect_same(watch.in_this_world(then, before_ns), then);
    ASSERT_TRUE(frame(yawed(100.0)));  // 91 degrees, of a head that stood still at 9
    // By a runtime that keeps the past in the world before, and by one that does not.
    expect_same(watch.in_this_world(then, before_ns), yawed(99.5));
    expect_same(watch.in_this_world(yawed(99.5), before_ns), yawed(99.5));
    // For a time of the new world there is no choice.
    expect_same(watch.in_this_world(then, now_ns), then);

    // Across two changes.
    ASSERT_TRUE(frame(yawed(-50.0)));
    expect_same(watch.in_this_world(then, before_ns), yawed(-50.5));
    expect_same(watch.in_this_world(yawed(99.5), before_ns), yawed(-50.5));
    expect_same(watch.in_this_world(yawed(-50.5), before_ns), yawed(-50.5));
}

TEST_F(Origin, ForgetsWorldsThatNoSampleIsFrom) {
    frames(10);
    ASSERT_TRUE(frame(yawed(90.0)));
    for (int i = 0; i < 60; ++i) {
        ASSERT_FALSE(frame(yawed(90.0)));
    }
    expect_same(watch.in_this_world(yawed(0.0), 0), yawed(0.0));
}

TEST_F(Origin, StandsTimesThatAreNone) {
    constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
    frames(3);
    watch.announce({kMin, yawed(90.0)});
    watch.announce({kMax, yawed(90.0)});
    ASSERT_TRUE(frame(yawed(-90.0)));
    EXPECT_FALSE(watch.next(kMax - 1, kPeriod_ns, yawed(-90.0)));
    EXPECT_FALSE(watch.next(kMin, kPeriod_ns, yawed(-90.0)));
    for (int i = 0; i < 100; ++i) {
        watch.announce({kMax, yawed(90.0)});
    }
    EXPECT_GT(watch.take_given_up(), 80U);
}

}  // namespace
}  // namespace gazeloop::gaze
