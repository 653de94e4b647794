#include "runtime/frame_timeline.h"
#include "runtime/gaze/head_track.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>

#include "runtime/time/clock.h"

namespace gazeloop {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kHour = 3'600'000 * kMs;
constexpr std::int64_t kStart = 10 * kHour;

present::TargetFrame announced(std::int64_t display_ns) {
    present::TargetFrame frame;
    frame.display = {display_ns, time::StampKind::Predicted};
    frame.aimed_ns = display_ns;
    frame.period_ns = 10 * kMs;
    return frame;
}

// A runtime whose announced times jump: each frame is for the time that was announced for it, and
// nothing of one jump is left in the next frame.
TEST(LiveTimeline, TakesAnnouncedTimesThatStepAsTheyAre) {
    LiveTimeline timeline(kStart);
    PlannedFrame frame;
    for (const std::int64_t since_ns :
         {std::int64_t{0}, 10 * kMs, kHour, 20 * kMs, -5 * kHour, 30 * kMs, 30 * kMs}) {
        timeline.plan(announced(kStart + since_ns), nullptr, frame);
        EXPECT_EQ(frame.display.ns, kStart + since_ns);
        EXPECT_EQ(frame.display.kind, time::StampKind::Predicted);
        EXPECT_DOUBLE_EQ(frame.scene_time_s, static_cast<double>(since_ns) * 1e-9);
        EXPECT_EQ(frame.period_ns, 10 * kMs);
    }
}

// The recorded head is asked for where it was: past either end it stands.
TEST(LiveTimeline, KeepsTheHeadFiniteWhereAnnouncedTimesStep) {
    gaze::HeadTrack track;
    track.add(kStart, gaze::Pose{.position_m = {0.0, 0.0, 0.0}});
    track.add(kStart + 100 * kMs, gaze::Pose{.position_m = {1.0, 0.0, 0.0}});
    LiveTimeline timeline(kStart);
    PlannedFrame frame;
    for (const std::int64_t since_ns : {-5 * kHour, 50 * kMs, 5 * kHour}) {
        timeline.plan(announced(kStart + since_ns), &track, frame);
        EXPECT_GE(frame.head.position_m.x, 0.0);
        EXPECT_LE(frame.head.position_m.x, 1.0);
        EXPECT_TRUE(std::isfinite(frame.views[0].pose.position_m.x));
    }
}

TEST(LiveTimeline, FollowsTheTargetsOriginUnlessTheSourceKnowsTheHead) {
    const gaze::Pose turned{glm::dquat{std::sqrt(0.5), 0.0, std::sqrt(0.5), 0.0}, {}};
    const auto planned = [&](const gaze::HeadMotion* head) {
        LiveTimeline timeline(kStart);
        PlannedFrame frame;
        timeline.plan(announced(kStart), head, frame);
        EXPECT_FALSE(frame.origin);
        present::TargetFrame target = announced(kStart + 10 * kMs);
        target.head = gaze::inverse(turned);
        target.new_origins = {{kStart + 5 * kMs, turned}};
        timeline.plan(target, head, frame);
        const bool moved = frame.origin.has_value();
        EXPECT_EQ(moved && frame.origin->announced, moved);
        const gaze::Pose before = timeline.in_this_world({}, kStart);
        EXPECT_NEAR(std::abs(glm::dot(before.orientation,
                                      moved ? target.head.orientation : gaze::Pose{}.orientation)),
                    1.0, 1e-12);
        return moved;
    };
    EXPECT_TRUE(planned(nullptr));
    gaze::HeadTrack track;
    track.add(kStart, gaze::Pose{});
    EXPECT_FALSE(planned(&track));
}

TEST(Timeline, KnowsOfSleepOnlyWhereTimePasses) {
    EXPECT_NEAR(static_cast<double>(LiveTimeline(kStart).slept_ns()),
                static_cast<double>(time::slept_ns()), 5e9);
    EXPECT_EQ(VirtualTimeline({.period_ns = 10 * kMs, .gpu_ns = kMs, .views = {}}).slept_ns(), 0);
}

}  // namespace
}  // namespace gazeloop
