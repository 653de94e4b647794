#include "drivers/openxr/gaze_reader.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>

#include "runtime/gaze/direction.h"
#include "tests/unit/gaze/painted_depth.h"

namespace gazeloop::drivers {
namespace {

constexpr std::int64_t kMs = 1'000'000;

gaze::Pose looking(double right_rad) {
    return {glm::angleAxis(-right_rad, glm::dvec3{0.0, 1.0, 0.0}), glm::dvec3{0.0}};
}

/// All gates open; the eye was seen 8 ms ago.
GazeAnswer answer(std::int64_t now_ms, double right_rad = 0.1) {
    const std::int64_t now_ns = now_ms * kMs;
    return {.focused = true,
            .bound = true,
            .active = true,
            .in_time = true,
            .valid = true,
            .tracked = true,
            .pose = looking(right_rad),
            .time = {.given = now_ns - 8 * kMs,
                     .host_ns = now_ns - 8 * kMs,
                     .asked = now_ns,
                     .now_ns = now_ns}};
}

class GazeReaderTest : public testing::Test {
  protected:
    std::optional<gaze::GazeSample> take(const GazeAnswer& given) {
        return reader_.take(given, gates_);
    }
    [[nodiscard]] bool is_open(GazeGate gate) const { return gates_.state(gate)->open; }

    GazeReader reader_{1.5};
    GazeGates gates_;
};

TEST_F(GazeReaderTest, MakesASampleOfAnAnswer) {
    const auto sample = take(answer(1000));
    ASSERT_TRUE(sample.has_value());
    EXPECT_EQ(sample->sequence, 1U);
    EXPECT_EQ(sample->sampled, (time::Stamp{992 * kMs, time::StampKind::Measured}));
    EXPECT_EQ(sample->arrived, (time::Stamp{1000 * kMs, time::StampKind::Measured}));
    EXPECT_EQ(sample->device_ns, 992 * kMs);
    EXPECT_EQ(reader_.pose_time(), 992 * kMs);
    EXPECT_EQ(sample->eyes[0].confidence, -1.0);
    EXPECT_TRUE(sample->eyes[0].valid && sample->eyes[1].valid);
    EXPECT_GT(sample->eyes[0].direction.x, std::sin(0.1)) << "the left eye turns more to the right";
    EXPECT_LT(sample->eyes[1].direction.x, std::sin(0.1));
    EXPECT_GT(*sample->parallax_rad, 0.0);
}

TEST_F(GazeReaderTest, TakesTheEyesFromWhereTheyAre) {
    reader_.place_eyes({glm::dvec3{-0.03, 0.01, 0.0}, glm::dvec3{0.03, 0.01, 0.0}});
    const auto sample = take(answer(1000, 0.0));
    EXPECT_EQ(sample->eyes[0].origin_m, (glm::dvec3{-0.03, 0.01, 0.0}));
    EXPECT_LT(sample->eyes[0].direction.y, 0.0);
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    reader_.place_eyes({glm::dvec3{kNan}, glm::dvec3{0.03, 0.0, 0.0}});
    reader_.place_eyes({glm::dvec3{0.03, 0.0, 0.0}, glm::dvec3{5.0, 0.0, 0.0}});
    EXPECT_EQ(take(answer(1014, 0.0))->eyes[0].origin_m, sample->eyes[0].origin_m);
}

// The same pose of the same time is no news.
TEST_F(GazeReaderTest, GivesASampleOnce) {
    GazeAnswer same = answer(1000);
    EXPECT_TRUE(take(same).has_value());
    same.time.now_ns += 5 * kMs;
    same.time.asked += 5 * kMs;
    EXPECT_FALSE(take(same).has_value());
    EXPECT_EQ(take(answer(1014, 0.11))->sequence, 2U);
}

TEST_F(GazeReaderTest, GivesASampleOnceWithoutTimesToo) {
    GazeAnswer timeless = answer(1000);
    timeless.time.given = 0;
    timeless.time.host_ns.reset();
    const auto sample = take(timeless);
    ASSERT_TRUE(sample.has_value());
    EXPECT_FALSE(sample->sampled.known());
    EXPECT_EQ(reader_.pose_time(), 0);
    EXPECT_FALSE(is_open(GazeGate::SampleTime));
    timeless.time.now_ns += 14 * kMs;
    EXPECT_FALSE(take(timeless).has_value());
    timeless.pose = looking(0.2);
    EXPECT_TRUE(take(timeless).has_value());
}

// Only a runtime that says when the eye was seen can say that it has not been seen since.
TEST_F(GazeReaderTest, KeepsAGazeThatRestsWithoutTimes) {
    for (const bool absurd : {false, true}) {
        GazeReader reader{1.5};
        GazeAnswer resting = answer(1000);
        resting.time.given = absurd ? -1 : 0;
        resting.time.host_ns.reset();
        std::int64_t last_ns = resting.time.now_ns;
        for (int frame = 0; frame < 100; ++frame) {
            if (const auto sample = reader.take(resting, gates_)) {
                EXPECT_TRUE(sample->eyes[0].valid && sample->eyes[1].valid);
                EXPECT_FALSE(sample->sampled.known());
                last_ns = sample->arrived.ns;
            }
            EXPECT_LE(resting.time.now_ns - last_ns, 28 * kMs);
            resting.time.now_ns += 14 * kMs;
        }
    }
}

TEST_F(GazeReaderTest, DoesNotKeepAGazeWhoseTimeStands) {
    GazeAnswer frozen = answer(1000);
    EXPECT_TRUE(take(frozen).has_value());
    for (int frame = 0; frame < 100; ++frame) {
        frozen.time.now_ns += 14 * kMs;
        frozen.time.asked += 14 * kMs;
        EXPECT_FALSE(take(frozen).has_value());
    }
}

TEST_F(GazeReaderTest, TellsALossOnce) {
    using Shut = void (*)(GazeAnswer&);
    const std::pair<GazeGate, Shut> ways[] = {
        {GazeGate::Focus, [](GazeAnswer& a) { a.focused = false; }},
        {GazeGate::Active, [](GazeAnswer& a) { a.active = false; }},
        {GazeGate::Pose, [](GazeAnswer& a) { a.in_time = a.valid = false; }},
        {GazeGate::Pose, [](GazeAnswer& a) { a.pose.reset(); }}};
    std::int64_t now_ms = 1000;
    for (const auto& [gate, shut] : ways) {
        EXPECT_TRUE(take(answer(now_ms))->eyes[0].valid);
        EXPECT_TRUE(is_open(gate));
        GazeAnswer without = answer(now_ms + 14);
        shut(without);
        const auto loss = take(without);
        ASSERT_TRUE(loss.has_value()) << describe(gate);
        EXPECT_FALSE(loss->eyes[0].valid || loss->eyes[1].valid);
        EXPECT_EQ(loss->arrived.ns, (now_ms + 14) * kMs);
        EXPECT_FALSE(is_open(gate));
        EXPECT_FALSE(take(without).has_value());
        now_ms += 100;
    }
}

// A time base of its own costs the age, not the gaze.
TEST_F(GazeReaderTest, FollowsGazeWhoseTimesAreAbsurd) {
    for (int i = 0; i < 50; ++i) {
        GazeAnswer elsewhere = answer(1000 + 14 * i);
        elsewhere.pose = looking(0.001 * i);
        elsewhere.time.given += 3'600'000 * kMs;
        elsewhere.time.host_ns = *elsewhere.time.host_ns + 3'600'000 * kMs;
        const auto sample = take(elsewhere);
        ASSERT_TRUE(sample.has_value()) << i;
        EXPECT_TRUE(sample->eyes[0].valid && sample->eyes[1].valid);
        EXPECT_FALSE(sample->sampled.known());
        EXPECT_EQ(reader_.pose_time(), 0);
    }
    EXPECT_FALSE(is_open(GazeGate::SampleTime));
    EXPECT_TRUE(is_open(GazeGate::Pose));
}

// Nor does one that is always the same: it stands still as little as it goes.
TEST_F(GazeReaderTest, FollowsGazeWhoseTimeIsAlwaysTheSameAbsurdOne) {
    for (int i = 0; i < 50; ++i) {
        GazeAnswer negative = answer(1000 + 14 * i);
        negative.pose = looking(0.001 * i);
        negative.time.given = -1;
        negative.time.host_ns.reset();
        ASSERT_TRUE(take(negative).has_value()) << i;
        EXPECT_EQ(gates_.state(GazeGate::SampleTime)->found, text_of(SampleTimeTrouble::Absurd));
    }
    EXPECT_EQ(gates_.take_events().size(), kGazeGateCount - 2) << "each gate is told once";
}

// Nobody has seen an eye yet: there is nothing to lose.
TEST_F(GazeReaderTest, LosesNothingBeforeTheFirstSample) {
    GazeAnswer nothing;
    EXPECT_FALSE(take(nothing).has_value());
    EXPECT_EQ(gates_.state(GazeGate::Pose), std::nullopt) << "not reached";
}

// Not the eyes are at fault where the runtime knows no pose for the time it is asked for.
TEST_F(GazeReaderTest, BlamesTheClockForAPoseThatCannotBeAskedFor) {
    EXPECT_TRUE(take(answer(1000)).has_value());
    GazeAnswer gap = answer(1014);
    gap.in_time = gap.valid = false;
    gap.pose.reset();
    EXPECT_FALSE(take(gap)->eyes[0].valid);
    const auto& state = gates_.state(GazeGate::Pose);
    EXPECT_NE(state->found.find("clock"), std::string_view::npos) << state->found;
    EXPECT_EQ(state->remedy.find("calibrate"), std::string_view::npos) << state->remedy;
    EXPECT_FALSE(state->remedy.empty());
    GazeAnswer unseen = answer(1028);
    unseen.valid = false;
    EXPECT_TRUE(take(unseen).has_value());
    EXPECT_EQ(gates_.state(GazeGate::Pose)->found, "the eyes are not seen");
    EXPECT_TRUE(gates_.state(GazeGate::Pose)->remedy.empty());
}

// A blink: the tracker answers, each time, that it sees no eye.
TEST_F(GazeReaderTest, SaysEachTimeThatNoEyeIsSeen) {
    EXPECT_TRUE(take(answer(1000)).has_value());
    for (std::int64_t i = 1; i < 4; ++i) {
        GazeAnswer blink = answer(1000 + 14 * i);
        blink.valid = false;
        blink.pose.reset();
        const auto sample = take(blink);
        ASSERT_TRUE(sample.has_value());
        EXPECT_FALSE(sample->eyes[0].valid);
    }
    EXPECT_TRUE(take(answer(1100))->eyes[0].valid);
}

TEST_F(GazeReaderTest, MarksSubNominalGaze) {
    GazeAnswer poor = answer(1000);
    poor.tracked = false;
    const auto sample = take(poor);
    EXPECT_EQ(sample->eyes[0].confidence, 0.0);
    EXPECT_FALSE(is_open(GazeGate::Pose));
}

// A runtime that does not say what is bound and gives gaze all the same.
TEST_F(GazeReaderTest, TakesGazeThatIsSaidNotToBeBound) {
    GazeAnswer unbound = answer(1000);
    unbound.bound = false;
    EXPECT_TRUE(take(unbound)->eyes[0].valid);
    EXPECT_EQ(gates_.state(GazeGate::Binding)->open, false);
}

// A predicted pose has a head to go with, and no age.
TEST_F(GazeReaderTest, KeepsTheTimeOfAPredictedPose) {
    GazeAnswer predicted = answer(1000);
    predicted.time.given = predicted.time.asked;
    predicted.time.host_ns = predicted.time.now_ns;
    EXPECT_FALSE(take(predicted)->sampled.known());
    EXPECT_EQ(reader_.pose_time(), 1000 * kMs);
    // Back from prediction, a sample that is older is not out of order.
    const auto next = take(answer(1005, 0.2));
    EXPECT_TRUE(next->sampled.known());
    EXPECT_GT(next->device_ns, 0);
}

/// Where both eyes' rays come nearest to each other, from the head's origin.
double meeting_m(const gaze::GazeSample& sample) {
    const glm::dvec3 aside = sample.eyes[1].origin_m - sample.eyes[0].origin_m;
    const glm::dvec3& a = sample.eyes[0].direction;
    const glm::dvec3& b = sample.eyes[1].direction;
    const double ab = glm::dot(a, b);
    const double along_a = (glm::dot(aside, a) - glm::dot(aside, b) * ab) / (1.0 - ab * ab);
    return glm::length(sample.eyes[0].origin_m + along_a * a);
}

TEST_F(GazeReaderTest, LetsTheEyesMeetWhereTheGazeMeetsTheScene) {
    const gaze::SeenDepth seen = gaze::painted(gaze::wall(0.4, -1.0, 1.0));
    auto sample = take(answer(1000, 0.0));
    EXPECT_NEAR(meeting_m(*sample), 1.5, 1e-9);
    const double assumed_rad = *sample->parallax_rad;
    reader_.meet_at_depth(*sample, gaze::Pose{}, seen);
    EXPECT_NEAR(meeting_m(*sample), 0.4, 0.002);
    EXPECT_LT(*sample->parallax_rad, 0.1 * assumed_rad);
    EXPECT_EQ(sample->eyes[0].confidence, -1.0);
    // A head elsewhere looks at the wall from there.
    GazeAnswer next = answer(1014, 0.2);
    sample = take(next);
    reader_.meet_at_depth(*sample, gaze::Pose{.position_m = {0.0, 0.0, -0.1}}, seen);
    EXPECT_NEAR(meeting_m(*sample), 0.3 / std::cos(0.2), 0.003);
}

TEST_F(GazeReaderTest, AssumesTheDistanceWhereNoDepthSaysIt) {
    const gaze::SeenDepth seen = gaze::painted(gaze::wall(0.4, -1.0, 1.0));
    auto sample = take(answer(1000, 0.0));
    const double assumed_rad = *sample->parallax_rad;
    reader_.meet_at_depth(*sample, gaze::Pose{}, {});
    EXPECT_NEAR(meeting_m(*sample), 1.5, 1e-9);
    EXPECT_EQ(sample->parallax_rad, assumed_rad);
    sample = take(answer(1014, 0.01));
    reader_.meet_at_depth(*sample, std::nullopt, seen);
    EXPECT_NEAR(meeting_m(*sample), 1.5, 1e-9) << "no head, no place in the world";
    sample = take(answer(1028, 1.2));
    reader_.meet_at_depth(*sample, gaze::Pose{}, seen);
    EXPECT_NEAR(meeting_m(*sample), 1.5, 1e-9) << "out of the picture";
}

TEST_F(GazeReaderTest, LeavesASampleWithoutGazeAlone) {
    EXPECT_TRUE(take(answer(1000)).has_value());
    GazeAnswer without = answer(1014);
    without.active = false;
    auto loss = take(without);
    ASSERT_TRUE(loss.has_value());
    reader_.meet_at_depth(*loss, gaze::Pose{}, gaze::painted(gaze::wall(0.4, -1.0, 1.0)));
    EXPECT_FALSE(loss->eyes[0].valid);
    EXPECT_FALSE(loss->parallax_rad.has_value());
}

TEST_F(GazeReaderTest, DoesNotTrustATimeThatStandsStill) {
    EXPECT_TRUE(take(answer(1000, 0.0))->sampled.known());
    int unknown = 0;
    for (std::int64_t i = 1; i < 20; ++i) {
        GazeAnswer still = answer(1000 + 14 * i, 0.01 * static_cast<double>(i));
        still.time.given = still.time.host_ns.emplace(992 * kMs);
        const auto sample = take(still);
        EXPECT_EQ(sample.has_value(), 14 * i >= 100) << i;
        if (sample) {
            EXPECT_FALSE(sample->sampled.known());
            ++unknown;
        }
    }
    EXPECT_GT(unknown, 10);
    EXPECT_FALSE(is_open(GazeGate::SampleTime));
    EXPECT_TRUE(take(answer(2000))->sampled.known());
}

}  // namespace
}  // namespace gazeloop::drivers
