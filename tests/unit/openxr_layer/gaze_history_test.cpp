#include "runtime/openxr_layer/gaze_history.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

namespace gazeloop::openxr_layer {
namespace {

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kStart = 1'000'000'000'000;

glm::dvec3 to(double azimuth_deg, double elevation_deg = 0.0) {
    const double a = glm::radians(azimuth_deg);
    const double e = glm::radians(elevation_deg);
    return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

gaze::GazeSample sample_at(std::int64_t ms, const glm::dvec3& direction, bool valid = true) {
    gaze::GazeSample sample;
    sample.sampled = {kStart + ms * kMs, time::StampKind::Measured};
    sample.arrived = {kStart + (ms + 2) * kMs, time::StampKind::Measured};
    for (gaze::EyeRay& ray : sample.eyes) {
        ray.direction = direction;
        ray.valid = valid;
    }
    return sample;
}

glm::dvec3 direction_of(const GazeAt& at) {
    return at.seen->in_head->orientation * glm::dvec3(0.0, 0.0, -1.0);
}

GazeAt asked(const GazeHistory& history, std::int64_t ms, std::int64_t now_ms) {
    return history.at(kStart + ms * kMs, kStart + now_ms * kMs);
}

TEST(GazeHistory, GivesTheNearestSample) {
    GazeHistory history(HistoryPolicy{});
    EXPECT_EQ(asked(history, 0, 0).seen, nullptr);
    for (int i = 0; i < 20; ++i) {
        history.add(sample_at(std::int64_t{10} * i, to(i)));
    }
    for (const auto& [ms, nearest] :
         {std::pair{0, 0}, {4, 0}, {6, 10}, {84, 80}, {86, 90}, {190, 190}, {260, 190}, {-40, 0}}) {
        const GazeAt at = asked(history, ms, 195);
        ASSERT_NE(at.seen, nullptr) << ms;
        EXPECT_EQ(at.seen->time_ns, kStart + nearest * kMs) << ms;
        EXPECT_TRUE(at.nominal);
    }
    EXPECT_EQ(asked(history, -101, 195).seen, nullptr) << "before all that is known";
}

TEST(GazeHistory, TellsHowFastTheGazeTurns) {
    GazeHistory history(HistoryPolicy{});
    history.add(sample_at(0, to(0)));
    EXPECT_FALSE(asked(history, 0, 3).turning);
    history.add(sample_at(10, to(3)));  // to the right: about -Y
    const auto turning = asked(history, 10, 13).turning;
    ASSERT_TRUE(turning);
    EXPECT_NEAR(turning->y, -glm::radians(300.0), 1e-9);
    EXPECT_NEAR(turning->x, 0.0, 1e-12);
    history.add(sample_at(100, to(4)));
    EXPECT_FALSE(asked(history, 100, 103).turning) << "too long ago";
    history.add(sample_at(110, to(4)));
    EXPECT_EQ(asked(history, 110, 113).turning, glm::dvec3(0.0));
}

TEST(GazeHistory, HoldsLostGazeAsSubNominal) {
    GazeHistory history({.hold_ns = 50 * kMs});
    history.add(sample_at(0, to(5)));
    for (int ms = 10; ms <= 100; ms += 10) {
        history.add(sample_at(ms, to(0), false));
    }
    GazeAt at = asked(history, 50, 102);
    ASSERT_NE(at.seen, nullptr);
    EXPECT_FALSE(at.nominal);
    EXPECT_EQ(at.seen->time_ns, kStart) << "the time of what was seen";
    EXPECT_FALSE(at.turning);
    EXPECT_NEAR(direction_of(at).x, to(5).x, 1e-12);
    EXPECT_EQ(asked(history, 60, 102).seen, nullptr);
}

TEST(GazeHistory, HoldsWhatIsStaleAndThenGivesItUp) {
    GazeHistory history({.stale_ns = 100 * kMs, .hold_ns = 50 * kMs});
    history.add(sample_at(0, to(5)));
    EXPECT_TRUE(asked(history, 90, 90).nominal);
    EXPECT_FALSE(asked(history, 110, 110).nominal);
    EXPECT_NE(asked(history, 150, 150).seen, nullptr);
    EXPECT_EQ(asked(history, 160, 160).seen, nullptr);
}

TEST(GazeHistory, TakesUnsureGazeForSubNominal) {
    GazeHistory history({.minimum_confidence = 0.6});
    gaze::GazeSample sample = sample_at(0, to(5));
    sample.eyes[0].confidence = 0.2;
    sample.eyes[1].confidence = 0.3;
    history.add(sample);
    EXPECT_NE(asked(history, 0, 2).seen, nullptr);
    EXPECT_FALSE(asked(history, 0, 2).nominal);
    sample = sample_at(10, to(5));
    sample.eyes[0].confidence = 0.2;
    sample.eyes[1].confidence = 0.9;
    history.add(sample);
    EXPECT_TRUE(asked(history, 10, 12).nominal);
}

TEST(GazeHistory, ForgetsWhenTheTrackerGoes) {
    GazeHistory history(HistoryPolicy{});
    history.add(sample_at(0, to(5)));
    gaze::GazeSample gone = sample_at(10, to(0), false);
    gone.tracker_gone = true;
    history.add(gone);
    EXPECT_EQ(asked(history, 10, 12).seen, nullptr);
    history.add(sample_at(20, to(0), false));
    EXPECT_EQ(asked(history, 20, 22).seen, nullptr) << "nothing from before it went";
}

TEST(GazeHistory, KeepsTheLastThousand) {
    GazeHistory history(HistoryPolicy{});
    constexpr auto kMany = static_cast<std::int64_t>(3 * GazeHistory::kMost);
    for (std::int64_t i = 0; i < kMany; ++i) {
        history.add(sample_at(i, to(0.001 * static_cast<double>(i))));
    }
    EXPECT_EQ(history.count(), 3 * GazeHistory::kMost);
    EXPECT_EQ(history.first(), 2 * GazeHistory::kMost);
    EXPECT_EQ(asked(history, kMany - 900, kMany).seen->time_ns, kStart + (kMany - 900) * kMs);
}

RC_GTEST_PROP(GazeHistory, GivesNothingThatIsNoPose, ()) {
    const auto numbers = rc::gen::element(0.0, -0.0, 1.0, -1.0, 1e-300, 1e300, 0.3,
                                          std::numeric_limits<double>::quiet_NaN(),
                                          std::numeric_limits<double>::infinity());
    GazeHistory history(HistoryPolicy{});
    const int count = *rc::gen::inRange(1, 30);
    for (int i = 0; i < count; ++i) {
        gaze::GazeSample sample =
            sample_at(*rc::gen::inRange(-50, 50), {*numbers, *numbers, *numbers},
                      *rc::gen::arbitrary<bool>());
        sample.eyes[1].origin_m = {*numbers, *numbers, *numbers};
        sample.eyes[0].confidence = *numbers;
        sample.tracker_gone = *rc::gen::inRange(0, 9) == 0;
        history.add(sample);
    }
    const std::int64_t extreme =
        *rc::gen::element<std::int64_t>(std::numeric_limits<std::int64_t>::min(),
                                        std::numeric_limits<std::int64_t>::max(), 0, kStart);
    for (const std::int64_t time : {extreme, kStart + *rc::gen::inRange(-80, 80) * kMs}) {
        const GazeAt at = history.at(time, *rc::gen::element(extreme, kStart + 60 * kMs));
        if (at.seen != nullptr) {
            RC_ASSERT(at.seen->in_head.has_value());
            RC_ASSERT(std::abs(glm::length(at.seen->in_head->orientation) - 1.0) < 1e-9);
            RC_ASSERT(std::isfinite(glm::length(at.seen->in_head->position_m)));
            RC_ASSERT(!at.turning || std::isfinite(glm::length(*at.turning)));
        }
    }
}

RC_GTEST_PROP(TurnTo, TurnsStraightAheadIntoTheDirectionWithoutRoll, ()) {
    const double azimuth = *rc::gen::inRange(-180'000, 180'000) * 1e-3;
    const double elevation = *rc::gen::inRange(-90'000, 90'001) * 1e-3;
    const glm::dvec3 direction = to(azimuth, elevation);
    const glm::dquat turned = turn_to(direction);
    RC_ASSERT(glm::length(turned * glm::dvec3(0.0, 0.0, -1.0) - direction) < 1e-12);
    RC_ASSERT(std::abs((turned * glm::dvec3(1.0, 0.0, 0.0)).y) < 1e-12);
}

}  // namespace
}  // namespace gazeloop::openxr_layer
