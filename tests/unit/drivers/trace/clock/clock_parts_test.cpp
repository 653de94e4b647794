// The parts that device_times.h is made of, on bare numbers.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "drivers/trace/clock/clock_chain.h"
#include "drivers/trace/clock/coarse_times.h"
#include "drivers/trace/clock/counter_wrap.h"

namespace gazeloop::drivers {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kTwoMs = 2 * kMs;
constexpr std::int64_t kThreeMs = 3 * kMs;

/// Which of these readings are left out, where steps of 1 join and steps back are impossible.
std::vector<std::size_t> left_out(const std::vector<int>& readings) {
    const memory::LongVector<bool> kept = readings_in_step(
        readings.size(),
        {.joins = [&](std::size_t a, std::size_t b) { return readings[b] - readings[a] == 1; },
         .doubt =
             [&](std::size_t a, std::size_t b) {
                 return readings[b] > readings[a] ? 0.0 : kImpossibleStep;
             }});
    std::vector<std::size_t> out;
    for (std::size_t i = 0; i < kept.size(); ++i) {
        if (!kept[i]) {
            out.push_back(i);
        }
    }
    return out;
}

std::vector<int> counted(int count) {
    std::vector<int> readings(static_cast<std::size_t>(count));
    std::iota(readings.begin(), readings.end(), 100);
    return readings;
}

TEST(ReadingsInStep, AreAllOfAGoodClock) {
    EXPECT_THAT(left_out({}), IsEmpty());
    EXPECT_THAT(left_out({5}), IsEmpty());
    EXPECT_THAT(left_out(counted(1000)), IsEmpty());
}

TEST(ReadingsInStep, LeaveABurstOut) {
    std::vector<int> readings = counted(200);
    readings[50] = 1000;
    readings[90] = 3;
    readings[91] = 4;
    readings[199] = 7;
    EXPECT_THAT(left_out(readings), ElementsAre(50, 90, 91, 199));
}

TEST(ReadingsInStep, KeepWhatLasts) {
    std::vector<int> readings = counted(200);
    for (std::size_t i = 120; i < 200; ++i) {
        readings[i] -= 60;
    }
    EXPECT_THAT(left_out(readings), IsEmpty());
    for (std::size_t i = 100; i < 120; ++i) {
        readings[i] += 500;  // 20 readings: no burst
    }
    EXPECT_THAT(left_out(readings), IsEmpty());
}

TEST(ReadingsInStep, KeepAllOfAClockThatNeverGoesForward) {
    std::vector<int> readings = counted(200);
    std::reverse(readings.begin(), readings.end());
    EXPECT_THAT(left_out(readings), IsEmpty());
}

TEST(ReadingsInStep, DoNotDoubtTheEndsOfAFewReadings) {
    std::vector<int> readings = counted(10);
    readings[0] = 900;
    EXPECT_THAT(left_out(readings), IsEmpty());
    readings[0] = 100;
    readings[5] = 900;
    EXPECT_THAT(left_out(readings), ElementsAre(5));
}

TEST(WrappedRange, KnowsTheUsualCounters) {
    const std::int64_t step = 11 * kThreeMs;
    for (const std::int64_t tick : {1, 100, 1'000, 1'000'000}) {
        const Wide range = static_cast<Wide>(tick) << 32;
        EXPECT_TRUE(wrapped_range(range - kTwoMs, kThreeMs, step) == range) << tick;
        EXPECT_TRUE(wrapped_range(range / 2 - kTwoMs, kThreeMs - range / 2, step) == range) << tick;
    }
}

/// Rows are missing around the wrap.
TEST(WrappedRange, IsKnownWithinAGap) {
    constexpr Wide kSecond = 1'000'000'000;
    const std::int64_t step = 11 * kThreeMs;
    const Wide range = Wide{1'000} << 32;
    for (const Wide gap : {2 * kSecond, 10 * kSecond, 29 * kSecond}) {
        EXPECT_TRUE(wrapped_range(range - kSecond, gap - kSecond, step) == range);
        EXPECT_TRUE(wrapped_range(range / 2 - kSecond, gap - kSecond - range / 2, step) == range);
    }
    EXPECT_FALSE(wrapped_range(range - kSecond, 40 * kSecond, step)) << "too far to be told";
    const OtherwiseElapsed elapsed{41 * kSecond, kSecond / 20};
    EXPECT_TRUE(wrapped_range(range - kSecond, 40 * kSecond, step, elapsed) == range);
    EXPECT_TRUE(wrapped_range(range - kSecond, 40 * kSecond, step, {}, elapsed) == range);
    EXPECT_FALSE(wrapped_range(range - kSecond, 20 * kSecond, step, elapsed)) << "the host objects";
    EXPECT_TRUE(wrapped_range(range - kSecond, 20 * kSecond, step, {}, elapsed) == range)
        << "numbers do not";
}
TEST(WrappedRange, IsNoneWhereAClockWasSetOrGoesOn) {
    const std::int64_t step = 11 * kThreeMs;
    const Wide range = Wide{1'000} << 32;
    EXPECT_FALSE(wrapped_range(kTwoMs, kThreeMs, step));
    EXPECT_FALSE(wrapped_range(range / 3, kThreeMs, step)) << "far from the end";
    EXPECT_FALSE(wrapped_range(range - kTwoMs, range / 100, step)) << "far from the start";
    EXPECT_FALSE(wrapped_range(range + kTwoMs, kThreeMs, step)) << "no such counter";
    EXPECT_FALSE(wrapped_range((Wide{1} << 16) - 5, 2, step)) << "shorter than a step";
}

std::vector<TimedRow> timed(const std::vector<std::int64_t>& at_ms) {
    std::vector<TimedRow> rows(at_ms.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].line = i + 2;
        rows[i].step_ns = i == 0 ? 0 : (at_ms[i] - at_ms[i - 1]) * kMs;
    }
    return rows;
}

TEST(Spread, TakesRowsOfOneTimeApartWithinTheStep) {
    const SpreadTimes times = spread(timed({0, 8, 8, 24, 24, 26}), 8 * kMs);
    // 24 and 24 have no more than the 2 ms to the next reading.
    EXPECT_THAT(times.step_ns, ElementsAre(0, 8 * kMs, 4 * kMs, 12 * kMs, 1 * kMs, 1 * kMs));
    EXPECT_THAT(times.coarse_ns, ElementsAre(8 * kMs, 8 * kMs, 8 * kMs, 8 * kMs, 8 * kMs, 8 * kMs));
    EXPECT_THAT(times.sets, IsEmpty());
}

TEST(Spread, LeavesTimesThatDifferAlone) {
    const auto rows = timed({0, 8, 17, 24});
    const SpreadTimes times = spread(rows, 8 * kMs);
    EXPECT_THAT(times.step_ns, ElementsAre(0, 8 * kMs, 9 * kMs, 7 * kMs));
    EXPECT_THAT(times.coarse_ns, ElementsAre(0, 0, 0, 0));
    EXPECT_THAT(times.findings, IsEmpty());
    EXPECT_EQ(times.interval_ns, 8 * kMs);
    EXPECT_THAT(spread({}, 0).step_ns, IsEmpty());
}

}  // namespace
}  // namespace gazeloop::drivers
