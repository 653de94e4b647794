#include "runtime/governor/governor.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <deque>
#include <functional>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/allocation_counter.h"

namespace gazeloop::governor {
namespace {

constexpr double kBudget_ms = 11.0;
constexpr SeenEyes kFixation{EyeState::Fixation, false};

/// Six levels; what they take without load, ms.
constexpr std::array kCost{20.0, 14.0, 10.0, 7.0, 5.0, 3.5};

/// A machine in virtual time: what a frame takes is known two frames later.
class Machine {
  public:
    explicit Machine(const GovernorOptions& options = {}, std::span<const double> cost = kCost,
                     std::span<const double> true_cost = kCost)
        : governor_(options, cost), true_cost_(true_cost.begin(), true_cost.end()) {}

    struct Frame {
        std::size_t level = 0;
        double ms = 0.0;
        std::optional<Decision> decided{};
    };

    /// A frame under a load: a factor on what the level takes.
    Frame frame(double load, const SeenEyes& eyes = kFixation, double budget_ms = kBudget_ms) {
        Frame frame;
        frame.decided = governor_.next(eyes, budget_ms);
        frame.level = governor_.level();
        frame.ms = true_cost_[frame.level] * load * noise_(random_);
        under_way_.push_back(frame);
        if (under_way_.size() > 2) {
            governor_.measured(under_way_.front().level, under_way_.front().ms);
            under_way_.pop_front();
        }
        return frame;
    }
    std::vector<Frame> frames(std::size_t count, double load, const SeenEyes& eyes = kFixation) {
        std::vector<Frame> all;
        all.reserve(count);
        for (std::size_t i = 0; i < count; ++i) {
            all.push_back(frame(load, eyes));
        }
        return all;
    }
    void set_noise(double deviation) { noise_ = std::normal_distribution<>(1.0, deviation); }
    Governor& governor() { return governor_; }

  private:
    Governor governor_;
    std::vector<double> true_cost_;
    std::deque<Frame> under_way_;
    std::mt19937 random_{7};
    std::normal_distribution<> noise_{1.0, 0.03};
};

std::size_t changes(const std::vector<Machine::Frame>& frames) {
    std::size_t count = 0;
    for (std::size_t i = 1; i < frames.size(); ++i) {
        count += frames[i].level != frames[i - 1].level ? 1 : 0;
    }
    return count;
}

double share_within(std::span<const Machine::Frame> frames) {
    const auto within =
        std::ranges::count_if(frames, [](const auto& frame) { return frame.ms <= kBudget_ms; });
    return static_cast<double>(within) / static_cast<double>(frames.size());
}

TEST(Governor, StartsWhereTheFrontSaysThatTheBudgetIsKept) {
    Machine machine;
    const auto first = machine.frame(1.0);
    EXPECT_EQ(first.level, 3U);  // 10 of 11 ms is more than its share
    ASSERT_TRUE(first.decided);
    EXPECT_EQ(first.decided->reason, Reason::Start);
    Governor none_fits(GovernorOptions{}, kCost);
    (void)none_fits.next(kFixation, 1.0);
    EXPECT_EQ(none_fits.level(), 5U);
}

/// Steps of every size, each from a settled state: kept in 99 % of the frames from the eleventh on.
TEST(Governor, KeepsTheBudgetTenFramesAfterAStep) {
    for (const double load : {0.3, 0.5, 0.8, 1.1, 1.4, 1.8, 2.2, 2.5, 2.7}) {
        for (const double noise : {0.0, 0.03, 0.05}) {
            Machine machine;
            machine.set_noise(noise);
            (void)machine.frames(400, 0.55);
            const auto after = machine.frames(2000, load);
            EXPECT_GE(share_within(std::span(after).subspan(10)), 0.99)
                << "load " << load << ", noise " << noise;
        }
    }
}

TEST(Governor, KeepsItWhereTheFrontIsWrongAboutThisMachine) {
    constexpr std::array kHere{20.0, 19.0, 16.0, 12.0, 8.0, 5.0};
    Machine machine({}, kCost, kHere);
    (void)machine.frames(300, 0.4);
    const auto after = machine.frames(3000, 1.2);
    EXPECT_GE(share_within(std::span(after).subspan(10)), 0.99);
    EXPECT_LE(changes(after), 12U);
}

/// Under a constant load it comes to rest: in 5000 frames no more changes than the way down or up.
TEST(Governor, DoesNotOscillate) {
    for (double load = 0.2; load < 3.3; load *= 1.03) {
        for (const double noise : {0.0, 0.04}) {
            Machine machine;
            machine.set_noise(noise);
            (void)machine.frames(400, 0.55);
            (void)machine.frames(400, load);
            EXPECT_LE(changes(machine.frames(5000, load)), 4U)
                << "load " << load << ", noise " << noise;
        }
    }
}

TEST(Governor, TriesABetterLevelMoreRarelyEachTimeItFails) {
    // The front promises that level 2 takes little more than level 3; here it does not.
    constexpr std::array kPromised{20.0, 14.0, 7.2, 7.0, 5.0, 3.5};
    constexpr std::array kHere{20.0, 14.0, 13.0, 7.0, 5.0, 3.5};
    Machine machine({}, kPromised, kHere);
    const auto frames = machine.frames(20'000, 1.0);
    // From level 2, where it starts, down to 4 and up to 3; then each try costs two changes, and
    // the waits double from 30 frames to 1920.
    EXPECT_GE(changes(frames), 8U);
    EXPECT_LE(changes(frames), 2U + 2U * (7U + 20'000U / 1920U));
    EXPECT_GE(share_within(frames), 0.99);
}

TEST(Governor, LeavesALevelOnlyWithHysteresis) {
    // Between what ends a level and what gives it back there is a stretch of load in which both the
    // way up and the way down end where they began.
    const auto settled = [](double from, double load) {
        Machine machine;
        machine.set_noise(0.0);
        (void)machine.frames(2000, from);
        (void)machine.frames(2000, load);
        return machine.governor().level();
    };
    bool remembers = false;
    for (double load = 0.5; load < 2.0; load *= 1.02) {
        const std::size_t from_light = settled(0.2, load);
        const std::size_t from_heavy = settled(3.0, load);
        EXPECT_LE(from_light, from_heavy) << load;
        EXPECT_LE(from_heavy - from_light, 1U) << load;
        remembers = remembers || from_heavy > from_light;
    }
    EXPECT_TRUE(remembers);
}

TEST(Governor, TakesItsTimeUpAndNoneDown) {
    Machine machine;
    (void)machine.frames(400, 1.0);
    ASSERT_EQ(machine.governor().level(), 3U);
    const auto heavy = machine.frames(10, 1.7);
    EXPECT_GT(heavy.back().level, 3U);
    const auto light = machine.frames(200, 0.5);
    for (std::size_t i = 1; i < light.size(); ++i) {
        EXPECT_LE(light[i - 1].level - light[i].level, 1U) << "one level at a time, frame " << i;
    }
    EXPECT_EQ(light[28].level, heavy.back().level) << "not before 30 frames";
    EXPECT_LT(light.back().level, 3U);
}

/// Random loads, states and floors: no frame is drawn below its state's floor.
TEST(Governor, NeverBreaksAFloor) {
    std::mt19937 random(3);
    for (int trial = 0; trial < 200; ++trial) {
        GovernorOptions options;
        for (std::size_t& worst : options.worst) {
            worst = random() % 7;
        }
        Machine machine(options);
        machine.set_noise(0.3);
        SeenEyes eyes{EyeState::Fixation, random() % 2 == 0};
        double load = 1.0;
        for (int i = 0; i < 1000; ++i) {
            if (random() % 20 == 0) {
                eyes.state = static_cast<EyeState>(random() % kEyeStateCount);
            }
            if (random() % 50 == 0) {
                load = std::exp(static_cast<double>(random() % 1000) / 250.0 - 2.0);
            }
            const auto frame = machine.frame(load, eyes);
            const std::size_t worst = options.worst[static_cast<std::size_t>(eyes.state)];
            ASSERT_LE(frame.level, std::min<std::size_t>(worst, kCost.size() - 1));
        }
    }
}

TEST(Governor, SaysOnceThatTheFloorHoldsItOverTheBudget) {
    GovernorOptions options;
    options.worst.fill(2);
    Machine machine(options);
    std::size_t held = 0;
    for (const auto& frame : machine.frames(500, 2.0)) {
        EXPECT_LE(frame.level, 2U);
        held += frame.decided && frame.decided->reason == Reason::Held ? 1 : 0;
    }
    EXPECT_EQ(held, 1U);
    (void)machine.frames(100, 0.9);  // kept again
    for (const auto& frame : machine.frames(500, 2.0)) {
        held += frame.decided && frame.decided->reason == Reason::Held ? 1 : 0;
    }
    EXPECT_EQ(held, 2U);
}

TEST(Governor, GoesDeeperWhereTheStateAllowsIt) {
    GovernorOptions options;
    options.worst = {2, 4, 5, 1};  // fixation, saccade, blink, lost
    Machine machine(options);
    (void)machine.frames(100, 2.0);
    EXPECT_EQ(machine.governor().level(), 2U);
    (void)machine.frames(20, 2.0, {EyeState::Saccade, true});
    EXPECT_EQ(machine.governor().level(), 4U);
    const auto back = machine.frame(2.0);
    EXPECT_EQ(back.level, 2U);
    ASSERT_TRUE(back.decided);
    EXPECT_EQ(back.decided->reason, Reason::Floor);
    EXPECT_EQ(machine.frame(2.0, {EyeState::Lost, false}).level, 1U);
}

/// A change for the better waits for a moment in which nobody sees it, but not for ever.
TEST(Governor, GoesUpInSaccadesAndBlinks) {
    const SeenEyes fixation{EyeState::Fixation, true};
    for (const EyeState hidden : {EyeState::Saccade, EyeState::Blink}) {
        Machine machine;
        (void)machine.frames(60, 1.5, fixation);
        const std::size_t level = machine.governor().level();
        EXPECT_EQ(changes(machine.frames(100, 0.5, fixation)), 0U);
        EXPECT_EQ(machine.frame(0.5, {hidden, true}).level, level - 1);
    }
    Machine machine;
    (void)machine.frames(60, 1.5, fixation);
    const std::size_t level = machine.governor().level();
    EXPECT_LT(machine.frames(40 + 180, 0.5, fixation).back().level, level);
    Machine lost;
    (void)lost.frames(60, 1.5);
    EXPECT_EQ(changes(lost.frames(500, 0.2, {EyeState::Lost, false})), 0U);
}

TEST(Governor, IsNotMovedByOddFramesThatNoLevelWouldHaveKept) {
    Machine machine;
    (void)machine.frames(400, 1.0);
    const std::size_t level = machine.governor().level();
    for (int i = 0; i < 3000; ++i) {
        (void)machine.frame(i % 40 == 0 ? 10.0 : 1.0);  // another program, now and then
    }
    EXPECT_EQ(machine.governor().level(), level);
}

TEST(Governor, MovesForRareFramesThatTheNextLevelKeeps) {
    Machine machine;
    (void)machine.frames(400, 1.0);
    const std::size_t level = machine.governor().level();
    for (int i = 0; i < 300; ++i) {
        (void)machine.frame(i % 30 == 0 ? 1.7 : 1.0);
    }
    EXPECT_EQ(machine.governor().level(), level + 1);
}

TEST(Governor, LearnsNothingFromWhatIsNoTime) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInf = std::numeric_limits<double>::infinity();
    Governor governor(GovernorOptions{}, kCost);
    (void)governor.next(kFixation, kBudget_ms);
    const std::size_t level = governor.level();
    for (int i = 0; i < 1000; ++i) {
        for (const double bad : {kNan, kInf, -kInf, 0.0, -3.0, 1e300, -0.0}) {
            governor.measured(governor.level(), bad);
        }
        governor.measured(level + 1, 100.0);  // of another level
        governor.measured(99, 100.0);
        ASSERT_FALSE(governor.next(kFixation, kBudget_ms));
    }
    for (const double unknown : {kNan, kInf, -kInf, 0.0, -1.0, 1e300}) {
        for (int i = 0; i < 100; ++i) {
            governor.measured(governor.level(), 100.0);
            ASSERT_FALSE(governor.next(kFixation, unknown)) << unknown;
        }
    }
    for (const double unknown : {kNan, 0.0, -1.0}) {
        Governor fresh(GovernorOptions{}, kCost);
        (void)fresh.next(kFixation, unknown);
        EXPECT_EQ(fresh.level(), 0U) << "no budget: the best picture";
    }
    // Extremes that are times.
    for (const double ms : {1e-300, 3.5e6}) {
        for (int i = 0; i < 1000; ++i) {
            governor.measured(governor.level(), ms);
            (void)governor.next(kFixation, kBudget_ms);
            ASSERT_LT(governor.level(), kCost.size());
        }
    }
}

TEST(Governor, OfOneLevelKeepsIt) {
    constexpr std::array kOne{5.0};
    Machine machine({}, kOne, kOne);
    EXPECT_EQ(changes(machine.frames(500, 10.0)), 0U);
    EXPECT_EQ(changes(machine.frames(500, 0.1)), 0U);
}

TEST(Governor, AllocatesNothing) {
    Governor governor(GovernorOptions{}, kCost);
    const std::size_t before = tests::allocations_of_this_thread();
    std::size_t told = 0;
    for (int i = 0; i < 2000; ++i) {
        if (const auto decision = governor.next(kFixation, kBudget_ms)) {
            told += decision_text(*decision).view().size();
        }
        governor.measured(governor.level(),
                          kCost[governor.level()] * (i / 500 % 2 == 0 ? 0.4 : 2.0));
    }
    EXPECT_EQ(tests::allocations_of_this_thread(), before);
    EXPECT_GT(told, 100U);
}

TEST(Governor, SaysWhyInWords) {
    EXPECT_EQ(decision_text({.from = 2,
                             .to = 3,
                             .reason = Reason::OverBudget,
                             .state = EyeState::Fixation,
                             .ms = 13.106,
                             .budget_ms = 11.1})
                  .view(),
              "level 3 -> 4: over the budget: 13.11 ms of 11.10 (fixation)");
    EXPECT_EQ(decision_text({.from = 4, .to = 2, .reason = Reason::Floor, .state = EyeState::Lost})
                  .view(),
              "level 5 -> 3: the floor of this state (lost)");
    const std::string_view longest =
        decision_text({.ms = std::numeric_limits<double>::max(), .budget_ms = 1e300}).view();
    EXPECT_LE(longest.size(), 240U);
}

TEST(Governor, SeesFromFoveaeWhatTheEyesDo) {
    const auto seen = [](gaze::FoveaState left, gaze::FoveaState right,
                         std::optional<gaze::EyeEvent> event = {}) {
        gaze::FrameFovea fovea;
        fovea.eyes[0].state = left;
        fovea.eyes[1].state = right;
        fovea.eyes[0].event = event;
        return seen_eyes(fovea);
    };
    using enum gaze::FoveaState;
    using gaze::EyeEvent;
    EXPECT_EQ(seen(Tracking, Tracking), (SeenEyes{EyeState::Fixation, false}));
    EXPECT_EQ(seen(OtherEye, Tracking, EyeEvent::Saccade), (SeenEyes{EyeState::Saccade, true}));
    EXPECT_EQ(seen(Tracking, Tracking, EyeEvent::Oscillation), (SeenEyes{EyeState::Saccade, true}));
    EXPECT_EQ(seen(Tracking, Tracking, EyeEvent::Pursuit), (SeenEyes{EyeState::Fixation, true}));
    EXPECT_EQ(seen(Held, Held), (SeenEyes{EyeState::Blink, false}));
    EXPECT_EQ(seen(Returning, Ahead), (SeenEyes{EyeState::Lost, false}));
}

TEST(WorstLevels, AreTheLastThatAreGoodEnough) {
    const Front front{.figure = "contrast",
                      .levels = {{.method = "full", .ms = 9.0, .loss = 0.5},
                                 {.method = "kfr", .ms = 4.0, .loss = 1.5},
                                 {.method = "acuity", .ms = 2.0, .loss = 3.0}}};
    const auto worst = worst_levels(front, {1.5, 0.0, 100.0, 0.5});
    ASSERT_TRUE(worst);
    EXPECT_EQ(*worst, (std::array<std::size_t, 4>{1, 2, 2, 0}));
    const auto refused = worst_levels(front, {0.0, 0.4, 0.0, 0.0});
    ASSERT_FALSE(refused);
    EXPECT_EQ(refused.error().kind, ErrorKind::Usage);
    EXPECT_THAT(refused.error().message, testing::HasSubstr("saccades"));
}

}  // namespace
}  // namespace gazeloop::governor
