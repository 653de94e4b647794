#include "drivers/openxr/gaze_gates.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace gazeloop::drivers {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;

constexpr std::int64_t kMs = 1'000'000;

void open_all(GazeGates& gates, std::int64_t now_ns) {
    for (std::size_t i = 0; i < kGazeGateCount; ++i) {
        gates.set(static_cast<GazeGate>(i), {true, "yes indeed"}, now_ns);
    }
}

TEST(GazeGates, AreShutUntilReached) {
    const GazeGates gates;
    EXPECT_EQ(gates.first_shut(), GazeGate::Extension);
    EXPECT_FALSE(gates.state(GazeGate::Pose).has_value());
}

TEST(GazeGates, AreShutByTheFirst) {
    for (std::size_t i = 0; i < kGazeGateCount; ++i) {
        GazeGates gates;
        open_all(gates, 0);
        EXPECT_EQ(gates.first_shut(), std::nullopt);
        const auto gate = static_cast<GazeGate>(i);
        gates.set(gate, {false, "just so"}, 1);
        EXPECT_EQ(gates.first_shut(), gate);
        EXPECT_FALSE(describe(gate).empty());
        EXPECT_FALSE(remedy(gate).empty());
    }
}

TEST(GazeGates, TellEachChangeOnce) {
    GazeGates gates;
    open_all(gates, 5);
    EXPECT_EQ(gates.take_events().size(), kGazeGateCount);
    open_all(gates, 6);
    EXPECT_THAT(gates.take_events(), IsEmpty());
    gates.set(GazeGate::Focus, {false, "a menu"}, 7);
    gates.set(GazeGate::Focus, {false, "a menu"}, 8);
    const std::vector<SourceEvent> events = gates.take_events();
    ASSERT_EQ(events.size(), 1U);
    EXPECT_EQ(events[0].text, "eye gaze: session focused: no (a menu)");
    EXPECT_EQ(events[0].time, (time::Stamp{7, time::StampKind::Measured}));
}

// Another reason is a change too.
TEST(GazeGates, TellWhyAGateIsShut) {
    GazeGates gates;
    gates.set(GazeGate::Pose, {false, "one thing"}, 0);
    gates.set(GazeGate::Pose, {false, "another"}, 1);
    EXPECT_EQ(gates.take_events().size(), 2U);
}

// To and fro with every frame for 10 s: a few lines a second, and the last word is right.
TEST(GazeGates, DoNotFloodTheLog) {
    GazeGates gates;
    std::size_t told = 0;
    for (std::int64_t frame = 0; frame < 900; ++frame) {
        gates.set(GazeGate::SampleTime, {frame % 2 == 0, "it flickers"}, frame * 11 * kMs);
        told += gates.take_events().size();
    }
    EXPECT_LE(told, 10U * GazeGates::kMostChanges);
    EXPECT_GE(told, 10U);
    gates.set(GazeGate::SampleTime, {false, "it stays"}, 20'000 * kMs);
    const std::vector<SourceEvent> last = gates.take_events();
    ASSERT_EQ(last.size(), 1U);
    EXPECT_THAT(last[0].text, HasSubstr("it stays"));
}

// What was held back is told once there is room.
TEST(GazeGates, TellTheLastChangeLate) {
    GazeGates gates;
    for (std::uint32_t i = 0; i <= GazeGates::kMostChanges; ++i) {
        gates.set(GazeGate::Active, {i % 2 == 0, "to and fro"}, i);
    }
    EXPECT_EQ(gates.take_events().size(), GazeGates::kMostChanges);
    gates.set(GazeGate::Active, {true, "to and fro"}, GazeGates::kWindow_ns / 2);
    EXPECT_THAT(gates.take_events(), IsEmpty());
    gates.set(GazeGate::Active, {true, "to and fro"}, GazeGates::kWindow_ns);
    const std::vector<SourceEvent> late = gates.take_events();
    ASSERT_EQ(late.size(), 1U);
    EXPECT_THAT(late[0].text, HasSubstr("action active: yes"));
}

TEST(GazeGates, StandAnyTime) {
    GazeGates gates;
    gates.set(GazeGate::Pose, {true, "a"}, std::numeric_limits<std::int64_t>::min());
    gates.set(GazeGate::Pose, {false, "b"}, std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(gates.take_events().size(), 2U);
}

}  // namespace
}  // namespace gazeloop::drivers
