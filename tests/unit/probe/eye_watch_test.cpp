#include "runtime/probe/eye_watch.h"

#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "runtime/probe/flip_log.h"

namespace gazeloop::probe {
namespace {

constexpr std::int64_t kMs = 1'000'000;
using gaze::FoveaState;
using gaze::LossReason;

time::Stamp at_ms(std::int64_t ms) { return {ms * kMs, time::StampKind::Measured}; }

gaze::GazeSample sample(std::uint64_t sequence, std::int64_t ms, bool left, bool right) {
    gaze::GazeSample one;
    one.sequence = sequence;
    one.sampled = at_ms(ms);
    one.arrived = at_ms(ms + 5);
    one.eyes[0].valid = left;
    one.eyes[1].valid = right;
    return one;
}

gaze::FrameFovea foveae(FoveaState left, FoveaState right, LossReason reason = LossReason::None) {
    gaze::FrameFovea fovea;
    fovea.eyes[0].state = left;
    fovea.eyes[0].reason = reason;
    fovea.eyes[1].state = right;
    fovea.eyes[1].reason = reason;
    return fovea;
}

const gaze::FrameFovea kBoth = foveae(FoveaState::Tracking, FoveaState::Tracking);
const gaze::FrameFovea kNone = foveae(FoveaState::Held, FoveaState::Held, LossReason::Invalid);

TEST(EyeWatch, TurnsWithTheFirstInvalidSampleAndBack) {
    EyeWatch watch(0.6);
    EXPECT_FALSE(watch.turns_at(foveae(FoveaState::Ahead, FoveaState::Ahead, LossReason::Never)));
    watch.add(sample(1, 0, true, true));
    EXPECT_FALSE(watch.turns_at(kBoth));
    watch.add(sample(2, 10, false, false));
    watch.add(sample(3, 20, false, false));
    EXPECT_TRUE(watch.turns_at(kNone));
    EXPECT_TRUE(watch.lost());
    EXPECT_EQ(watch.turn().sample, 2U);
    EXPECT_EQ(watch.turn().sampled, at_ms(10));
    EXPECT_EQ(watch.turn().arrived, at_ms(15));
    EXPECT_EQ(watch.turn().reason, LossReason::Invalid);
    EXPECT_FALSE(watch.turns_at(kNone));
    watch.add(sample(4, 30, true, true));
    EXPECT_TRUE(watch.turns_at(kBoth));
    EXPECT_FALSE(watch.lost());
    EXPECT_EQ(watch.turn().sample, 4U);
    EXPECT_EQ(watch.turn().reason, LossReason::None);
}

TEST(EyeWatch, OneBlindedEyeIsEnoughAndBothMustBeBack) {
    EyeWatch watch(0.6);
    watch.add(sample(1, 0, true, true));
    EXPECT_FALSE(watch.turns_at(kBoth));
    watch.add(sample(2, 10, true, false));
    EXPECT_TRUE(watch.turns_at(foveae(FoveaState::Tracking, FoveaState::OtherEye)));
    EXPECT_EQ(watch.turn().sample, 2U);
    EXPECT_EQ(watch.turn().reason, LossReason::Invalid);
    watch.add(sample(3, 20, false, false));
    EXPECT_FALSE(watch.turns_at(kNone));
    watch.add(sample(4, 30, false, true));
    EXPECT_FALSE(watch.turns_at(foveae(FoveaState::OtherEye, FoveaState::Tracking)));
    watch.add(sample(5, 40, true, true));
    EXPECT_TRUE(watch.turns_at(kBoth));
    EXPECT_EQ(watch.turn().sample, 5U);
}

TEST(EyeWatch, AnEyeThatWasNeverSeenIsNotWatched) {
    EyeWatch watch(0.6);
    watch.add(sample(1, 0, true, false));
    EXPECT_FALSE(watch.turns_at(foveae(FoveaState::Tracking, FoveaState::OtherEye)));
    watch.add(sample(2, 10, false, false));
    EXPECT_TRUE(watch.turns_at(kNone));
    EXPECT_EQ(watch.turn().sample, 2U);
}

TEST(EyeWatch, SilenceIsALossWithoutASample) {
    EyeWatch watch(0.6);
    watch.add(sample(1, 0, true, true));
    EXPECT_FALSE(watch.turns_at(kBoth));
    EXPECT_TRUE(watch.turns_at(foveae(FoveaState::Held, FoveaState::Held, LossReason::Stale)));
    EXPECT_EQ(watch.turn().reason, LossReason::Stale);
    EXPECT_FALSE(watch.turn().sampled.known());
    watch.add(sample(2, 500, true, true));
    EXPECT_TRUE(watch.turns_at(kBoth));
    EXPECT_EQ(watch.turn().sample, 2U);
}

TEST(EyeWatch, LittleConfidenceIsNoGaze) {
    EyeWatch watch(0.6);
    watch.add(sample(1, 0, true, true));
    EXPECT_FALSE(watch.turns_at(kBoth));
    gaze::GazeSample doubtful = sample(2, 10, true, true);
    doubtful.eyes[0].confidence = doubtful.eyes[1].confidence = 0.5;
    watch.add(doubtful);
    EXPECT_TRUE(watch.turns_at(kNone));
    EXPECT_EQ(watch.turn().sample, 2U);
}

Flip flip(bool lost, std::uint64_t frame, std::int64_t ms) {
    return {.lost = lost,
            .reason = lost ? LossReason::Invalid : LossReason::None,
            .frame = frame,
            .sample = frame,
            .sampled = at_ms(ms),
            .arrived = at_ms(ms + 5),
            .latched = at_ms(ms + 8),
            .display = at_ms(ms + 20),
            .shown = {},
            .period_ns = 11 * kMs};
}

TEST(FlipLog, TellsLampsFromBlinksByTheirLength) {
    FlipLog log;
    log.add(flip(true, 10, 100));
    log.add(flip(false, 20, 300));
    log.add(flip(true, 30, 1000));
    log.add(flip(false, 60, 1600));
    log.add(flip(true, 90, 2000));
    EXPECT_EQ(log.lamp_flashes(), 1U);
    log.set_shown(30, at_ms(1010));
    log.set_shown(60, at_ms(1621));
    log.set_shown(61, at_ms(1622));
    const std::vector<Loss> losses = log.losses();
    ASSERT_EQ(losses.size(), 3U);
    EXPECT_EQ(losses[0].lasted().ns, 200 * kMs);
    EXPECT_EQ(losses[1].lost.shown, at_ms(1020));
    EXPECT_EQ(losses[1].found->shown.ns, 1631 * kMs) << "the GPU was late by a period";
    EXPECT_FALSE(losses[2].found);
    EXPECT_FALSE(losses[2].lasted().known());
    const auto json = flips_json(log);
    EXPECT_EQ(json["losses"][0]["cause"], "blink");
    EXPECT_EQ(json["losses"][1]["cause"], "lamp");
    EXPECT_EQ(json["losses"][2]["cause"], "still lost");
    EXPECT_EQ(json["losses"][2]["lasted_ns"], nullptr);
    EXPECT_EQ(json["losses"][0]["lost"]["shown"]["ns"], nullptr);
    EXPECT_EQ(json["losses"][1]["lost"]["shown"]["ns"], 1020 * kMs);
}

TEST(FlipLog, HasRoomForManyAndCountsTheRest) {
    FlipLog log;
    for (std::uint64_t i = 0; i < FlipLog::kMost + 3; ++i) {
        log.add(flip(i % 2 == 0, i, static_cast<std::int64_t>(i)));
    }
    EXPECT_EQ(log.flips().size(), FlipLog::kMost);
    EXPECT_EQ(log.not_kept(), 3U);
    EXPECT_NE(flips_text(log).find("not kept 3 further flips"), std::string::npos);
    EXPECT_NE(flips_text(FlipLog()).find("never lost the eye"), std::string::npos);
}

}  // namespace
}  // namespace gazeloop::probe
