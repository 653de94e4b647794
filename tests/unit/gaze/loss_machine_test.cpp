#include "runtime/gaze/loss_machine.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>
#include <string>
#include <vector>

namespace gazeloop::gaze {
namespace {

constexpr std::int64_t kMs = 1'000'000;

LossPolicy policy() {
    return {.stale_ns = 100 * kMs,
            .hold_ns = 300 * kMs,
            .return_ns = 200 * kMs,
            .minimum_confidence = 0.6,
            .blink_hold_ns = 500 * kMs,
            .unplugged_hold_ns = 40 * kMs,
            .reopen_ns = 30 * kMs,
            .closed_below = 0.4,
            .field_rad = glm::radians(60.0),
            .hold_for_ever = false};
}

time::Stamp at_ms(std::int64_t ms) { return {ms * kMs, time::StampKind::Modelled}; }

/// What one sample says of both eyes.
enum class Says { Open, Winks, Shut, HalfShut, NotSeen, Unsure, Outside, Gone };

GazeSample sample_of(Says says, std::int64_t ms) {
    GazeSample sample;
    sample.sampled = at_ms(ms);
    sample.arrived = at_ms(ms);
    for (EyeRay& ray : sample.eyes) {
        ray.valid = says != Says::NotSeen && says != Says::Gone && says != Says::HalfShut;
        ray.openness = says == Says::Shut ? 0.2 : says == Says::Open ? 0.8 : -1.0;
        ray.confidence = says == Says::Unsure ? 0.5 : -1.0;
        if (says == Says::Outside) {
            ray.direction = {std::sin(glm::radians(61.0)), 0.0, -std::cos(glm::radians(61.0))};
        }
    }
    if (says == Says::Winks || says == Says::HalfShut) {
        sample.eyes[0].openness = 0.1;
    }
    sample.tracker_gone = says == Says::Gone;
    return sample;
}

struct Step {
    Says says;
    GazePresence presence;
    LossCause cause;
};

/// A sample every 10 ms; after each, where the machine is.
void expect_steps(const std::vector<Step>& steps, const LossPolicy& with = policy()) {
    LossMachine machine(with);
    std::int64_t ms = 0;
    for (const auto& [says, presence, cause] : steps) {
        const auto judged = machine.add(sample_of(says, ms));
        ASSERT_TRUE(judged.has_value());
        EXPECT_EQ(kGazePresenceNames[static_cast<std::size_t>(machine.presence())],
                  kGazePresenceNames[static_cast<std::size_t>(presence)])
            << "at " << ms << " ms";
        EXPECT_EQ(kLossCauseNames[static_cast<std::size_t>(machine.cause())],
                  kLossCauseNames[static_cast<std::size_t>(cause)])
            << "at " << ms << " ms";
        EXPECT_EQ(judged->usable, presence == GazePresence::Seen) << "at " << ms << " ms";
        ms += 10;
    }
}

using enum GazePresence;

TEST(LossMachine, LeavesNeverOnlyByGaze) {
    expect_steps({{Says::NotSeen, Never, LossCause::None},
                  {Says::Shut, Never, LossCause::None},
                  {Says::Unsure, Never, LossCause::None},
                  {Says::Gone, Never, LossCause::None},
                  {Says::Open, Seen, LossCause::None}});
}

TEST(LossMachine, NamesEachCauseAndComesBackFromIt) {
    for (const auto& [says, cause] :
         std::vector<std::pair<Says, LossCause>>{{Says::NotSeen, LossCause::NotSeen},
                                                 {Says::Unsure, LossCause::LowConfidence},
                                                 {Says::Outside, LossCause::OutsideField},
                                                 {Says::Gone, LossCause::Unplugged}}) {
        expect_steps({{Says::Open, Seen, LossCause::None},
                      {says, Lost, cause},
                      {says, Lost, cause},
                      {Says::Open, Seen, LossCause::None}});
    }
    // From one cause to another, without gaze between.
    expect_steps({{Says::Open, Seen, LossCause::None},
                  {Says::NotSeen, Lost, LossCause::NotSeen},
                  {Says::Unsure, Lost, LossCause::LowConfidence},
                  {Says::Gone, Lost, LossCause::Unplugged},
                  {Says::NotSeen, Lost, LossCause::NotSeen},
                  {Says::Shut, Shut, LossCause::Blink}});
}

TEST(LossMachine, WaitsAfterABlinkUntilTheEyesAreWideOpen) {
    expect_steps({{Says::Open, Seen, LossCause::None},
                  {Says::Shut, Shut, LossCause::Blink},
                  {Says::NotSeen, Shut, LossCause::Blink},  // a shut eye has no pupil to see
                  {Says::Shut, Shut, LossCause::Blink},
                  {Says::Open, Opening, LossCause::Blink},  // for 30 ms
                  {Says::Open, Opening, LossCause::Blink},
                  {Says::Open, Opening, LossCause::Blink},
                  {Says::Open, Seen, LossCause::None},
                  {Says::Open, Seen, LossCause::None}});
    // Shut again while they open: the time counts anew.
    expect_steps({{Says::Open, Seen, LossCause::None},
                  {Says::Shut, Shut, LossCause::Blink},
                  {Says::Open, Opening, LossCause::Blink},
                  {Says::Open, Opening, LossCause::Blink},
                  {Says::Shut, Shut, LossCause::Blink},
                  {Says::Open, Opening, LossCause::Blink},
                  {Says::Open, Opening, LossCause::Blink},
                  {Says::Open, Opening, LossCause::Blink},
                  {Says::Open, Seen, LossCause::None}});
    LossPolicy at_once = policy();
    at_once.reopen_ns = 0;
    expect_steps({{Says::Open, Seen, LossCause::None},
                  {Says::Shut, Shut, LossCause::Blink},
                  {Says::Open, Seen, LossCause::None}},
                 at_once);
    // No such wait after another loss.
    expect_steps({{Says::Open, Seen, LossCause::None},
                  {Says::NotSeen, Lost, LossCause::NotSeen},
                  {Says::Open, Seen, LossCause::None}});
}

TEST(LossMachine, TakesAWinkForGazeOfTheOtherEye) {
    LossMachine machine(policy());
    const auto judged = machine.add(sample_of(Says::Winks, 0));
    EXPECT_EQ(machine.presence(), Seen);
    EXPECT_FALSE(judged->directions[0].has_value());
    EXPECT_TRUE(judged->directions[1].has_value());
    EXPECT_EQ(judged->causes[0], LossCause::Blink);
    EXPECT_EQ(judged->causes[1], LossCause::None);
    // One shut, one not seen: a blink.
    (void)machine.add(sample_of(Says::HalfShut, 10));
    EXPECT_EQ(machine.presence(), Shut);
}

TEST(LossMachine, LooksAtNoOpennessUnlessItIsTold) {
    LossPolicy plain = policy();
    plain.closed_below = 0.0;
    expect_steps({{Says::Shut, Seen, LossCause::None}}, plain);
    GazeSample odd = sample_of(Says::Open, 0);
    odd.eyes[0].openness = std::numeric_limits<double>::quiet_NaN();
    odd.eyes[1].openness = -1.0;
    LossMachine machine(policy());
    EXPECT_TRUE(machine.add(odd)->usable) << "openness that is not stated";
}

struct Expected {
    std::int64_t ms;
    FoveaState state;
    LossReason reason;
};

void expect_conditions(const LossMachine& machine, LossCause cause,
                       const std::vector<Expected>& expected) {
    for (const auto& [ms, state, reason] : expected) {
        const LossCondition condition = machine.condition(ms * kMs);
        EXPECT_EQ(kFoveaStateNames[static_cast<std::size_t>(condition.state)],
                  kFoveaStateNames[static_cast<std::size_t>(state)])
            << "at " << ms << " ms";
        EXPECT_EQ(kLossReasonNames[static_cast<std::size_t>(condition.reason)],
                  kLossReasonNames[static_cast<std::size_t>(reason)])
            << "at " << ms << " ms";
        const LossCause because = state == FoveaState::Tracking ? LossCause::None : cause;
        EXPECT_EQ(condition.cause, because) << "at " << ms << " ms";
    }
}

// Each cause has its hold, all the same way back; the newest sample was at 10 ms.
TEST(LossMachine, HoldsForAsLongAsTheCauseIsHeldAndThenReturns) {
    using enum FoveaState;
    const auto lost = [](Says says) {
        LossMachine machine(policy());
        (void)machine.add(sample_of(Says::Open, 0));
        (void)machine.add(sample_of(says, 10));
        return machine;
    };
    expect_conditions(lost(Says::Unsure), LossCause::LowConfidence,
                      {{10, Held, LossReason::Invalid},
                       {110, Held, LossReason::Invalid},
                       {111, Held, LossReason::Stale},
                       {300, Held, LossReason::Stale},
                       {301, Returning, LossReason::Stale},
                       {499, Returning, LossReason::Stale},
                       {500, Ahead, LossReason::Stale}});
    expect_conditions(lost(Says::Shut), LossCause::Blink,
                      {{500, Held, LossReason::Stale},
                       {501, Returning, LossReason::Stale},
                       {700, Ahead, LossReason::Stale}});
    expect_conditions(lost(Says::Gone), LossCause::Unplugged,
                      {{40, Held, LossReason::Invalid},
                       {41, Returning, LossReason::Invalid},
                       {240, Ahead, LossReason::Stale}});
    const LossCondition half = lost(Says::Unsure).condition(400 * kMs);
    EXPECT_DOUBLE_EQ(half.returned, 0.5);
    LossPolicy staying = policy();
    staying.hold_for_ever = true;
    LossMachine stays(staying);
    (void)stays.add(sample_of(Says::Open, 0));
    (void)stays.add(sample_of(Says::NotSeen, 10));
    expect_conditions(stays, LossCause::NotSeen, {{1'000'000, Held, LossReason::Stale}});
}

TEST(LossMachine, TellsThatSamplesStoppedFromAClockThatStepped) {
    using enum FoveaState;
    LossMachine machine(policy());
    EXPECT_EQ(machine.condition(0).reason, LossReason::Never);
    (void)machine.add(sample_of(Says::Open, 1000));
    expect_conditions(machine, LossCause::Stopped,
                      {{1100, Tracking, LossReason::None}, {1101, Held, LossReason::Stale}});
    // One sample from before: it is not used, and what follows it is.
    EXPECT_FALSE(machine.add(sample_of(Says::Open, 10)).has_value());
    expect_conditions(machine, LossCause::ClockStep,
                      {{1100, Tracking, LossReason::None}, {1101, Held, LossReason::Stale}});
    EXPECT_TRUE(machine.add(sample_of(Says::Open, 20)).has_value());
}

TEST(LossMachine, CountsAgeByTheSampleAndByItsArrival) {
    LossMachine machine(policy());
    GazeSample sample = sample_of(Says::Open, 0);
    sample.sampled = {};
    (void)machine.add(sample);
    EXPECT_EQ(machine.condition(100 * kMs).state, FoveaState::Tracking);
    EXPECT_EQ(machine.condition(101 * kMs).state, FoveaState::Held);
    sample.arrived = {};
    (void)machine.add(sample);
    EXPECT_EQ(machine.condition(0).state, FoveaState::Ahead) << "of unknown age";
    // In the blink that follows, a sample without any time ends the wait at once.
    (void)machine.add(sample_of(Says::Shut, 20));
    sample.eyes[0].openness = 0.9;
    (void)machine.add(sample);
    EXPECT_EQ(machine.presence(), Seen);
}

}  // namespace
}  // namespace gazeloop::gaze
