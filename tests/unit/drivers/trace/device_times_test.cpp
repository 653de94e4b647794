#include "drivers/trace/device_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "tests/unit/drivers/trace/trace_rows.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::int64_t kInterval = 8'333'333;

bool increases(const std::vector<std::int64_t>& times) {
    return std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
}

/// The times of good_rows() without row `dropped`.
void expect_good_but(const DeviceTimes& times, std::size_t count,
                     const std::vector<std::size_t>& dropped) {
    std::vector<std::size_t> rows;
    for (std::size_t i = 0; i < count; ++i) {
        if (std::find(dropped.begin(), dropped.end(), i) == dropped.end()) {
            rows.push_back(i);
        }
    }
    ASSERT_EQ(times.rows, rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ASSERT_EQ(times.time_ns[i], static_cast<std::int64_t>(rows[i] - rows[0]) * kInterval) << i;
    }
}

/// One finding of that kind and no other: its line and how many rows it drops.
void expect_one(const DeviceTimes& times, TraceFindingKind kind, std::uint64_t line,
                std::uint64_t dropped) {
    ASSERT_THAT(times.findings, SizeIs(1));
    EXPECT_EQ(times.findings[0].kind, kind);
    EXPECT_EQ(times.findings[0].line, line);
    EXPECT_EQ(times.findings[0].dropped, dropped);
    EXPECT_FALSE(times.findings[0].text.empty());
}

TEST(DeviceTimes, OfAGoodTraceAreItsReadings) {
    const auto rows = good_rows(100);
    const DeviceTimes times = device_times(rows, 1.0);
    expect_good_but(times, 100, {});
    EXPECT_THAT(times.findings, IsEmpty());
    EXPECT_THAT(times.sets, IsEmpty());
    EXPECT_EQ(times.interval_ns, kInterval);
    EXPECT_EQ(times.reading_ns.front(), 3 * kSecond);
    EXPECT_EQ(times.step_ns, std::vector<std::int64_t>(100, 0));
}

TEST(DeviceTimes, CountTicksOfOtherLengthsFromTheFirst) {
    const auto rows = good_rows(3, 638'342'794'000'115'346, 83'333);
    const DeviceTimes times = device_times(rows, 100.0);
    EXPECT_THAT(times.time_ns, ElementsAre(0, 8'333'300, 16'666'600));
    EXPECT_EQ(times.reading_ns, times.time_ns);
    EXPECT_THAT(device_times(rows, 100.5).time_ns, ElementsAre(0, 8'374'966, 16'749'933));
}

TEST(DeviceTimes, KeepGapsForward) {
    auto rows = without_sequence(good_rows(100));
    move_times(rows, 40, 100, kSecond);
    move_times(rows, 41, 100, kSecond);
    const DeviceTimes times = device_times(rows, 1.0);
    EXPECT_THAT(times.findings, IsEmpty());
    EXPECT_EQ(times.rows.size(), 100U);
    EXPECT_EQ(times.time_ns[41] - times.time_ns[40], kSecond + kInterval);
}

// ---- Outliers -----------------------------------------------------------------------------------

class Outlier : public ::testing::TestWithParam<std::int64_t> {};

TEST_P(Outlier, IsDroppedAloneWhereverItIs) {
    for (const std::size_t at : {0U, 1U, 2U, 399U, 500U, 797U, 798U, 799U}) {
        for (const bool numbered : {true, false}) {
            auto rows = good_rows(800);
            rows = numbered ? rows : without_sequence(rows);
            move_times(rows, at, at + 1, GetParam());
            const DeviceTimes times = device_times(rows, 1.0);
            expect_good_but(times, 800, {at});
            expect_one(times, TraceFindingKind::TimeOutlier, at + 2, 1);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Far, Outlier,
                         ::testing::Values(2'500 * kMs, -2'500 * kMs, 3600 * kSecond,
                                           -3600 * kSecond, 1'700'000'000 * kSecond,
                                           std::int64_t{9'000'000'000'000'000'000},
                                           std::int64_t{-9'000'000'000'000'000'000}));

TEST(DeviceTimes, DropASpikeOfAFewIntervals) {
    for (const std::int64_t by : {3 * kInterval / 2, 20 * kInterval + 17, 20 * kInterval,
                                  60 * kInterval + 1, -3 * kInterval / 2, -20 * kInterval - 17}) {
        for (const bool numbered : {true, false}) {
            auto rows = good_rows(800);
            rows = numbered ? rows : without_sequence(rows);
            move_times(rows, 400, 401, by);
            const DeviceTimes times = device_times(rows, 1.0);
            expect_good_but(times, 800, {400});
            expect_one(times, TraceFindingKind::TimeOutlier, 402, 1);
        }
    }
}

TEST(DeviceTimes, DropTwoSpikesInARowAndABurst) {
    auto rows = good_rows(800);
    move_times(rows, 100, 101, 2'500 * kMs);
    move_times(rows, 101, 102, 900 * kMs);
    move_times(rows, 300, 308, -40 * kSecond);
    const DeviceTimes times = device_times(rows, 1.0);
    expect_good_but(times, 800, {100, 101, 300, 301, 302, 303, 304, 305, 306, 307});
    const auto outliers = of_kind(times.findings, TraceFindingKind::TimeOutlier);
    ASSERT_THAT(outliers, SizeIs(2));
    EXPECT_EQ(outliers[0].dropped, 2U);
    EXPECT_EQ(outliers[1].dropped, 8U);
    EXPECT_EQ(times.findings.size(), 2U);
}

TEST(DeviceTimes, DropAFirstTimeOfZeroBeforeAnEpoch) {
    auto rows = good_rows(400, 1'700'000'000 * kSecond);
    rows[0].device_ticks = 0;
    const DeviceTimes times = device_times(rows, 1.0);
    expect_good_but(times, 400, {0});
    expect_one(times, TraceFindingKind::TimeOutlier, 2, 1);
}

TEST(DeviceTimes, DropFirstRowsOfAnEarlierRunOfTheDevice) {
    for (const bool timed : {false, true}) {
        auto rows = good_rows(400);
        move_times(rows, 0, 10, 40'000 * kSecond);
        rows = timed ? with_host(rows, 0) : rows;
        for (std::size_t i = 0; timed && i < 10; ++i) {
            *rows[i].host_ns -= 40'000 * kSecond;
        }
        const DeviceTimes times = device_times(rows, 1.0);
        expect_good_but(times, 400, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
        expect_one(times, TraceFindingKind::TimeOutlier, 2, 10);
    }
}

TEST(DeviceTimes, KeepALastRowThatTheHostVouchesFor) {
    auto rows = good_rows(100);
    move_times(rows, 99, 100, 5 * kSecond);
    rows = with_host(rows, 7 * kSecond);
    EXPECT_EQ(device_times(rows, 1.0).rows.size(), 100U);
}

TEST(DeviceTimes, ReportRowsWithoutATime) {
    auto rows = good_rows(100);
    rows[0].device_ticks.reset();
    rows[50].device_ticks.reset();
    const DeviceTimes times = device_times(rows, 1.0);
    expect_good_but(times, 100, {0, 50});
    expect_one(times, TraceFindingKind::BadTime, 2, 2);
    for (TraceRow& row : rows) {
        row.device_ticks.reset();
    }
    EXPECT_THAT(device_times(rows, 1.0).rows, IsEmpty());
    rows = with_host(good_rows(100), 0);
    for (TraceRow& row : rows) {
        row.device_ticks.reset();
    }
    const DeviceTimes by_host = device_times(rows, 1.0);
    expect_good_but(by_host, 100, {});
    EXPECT_TRUE(by_host.by_host);
    expect_one(by_host, TraceFindingKind::BadTime, 2, 0);
}

// ---- Clocks that wrap or are set ----------------------------------------------------------------

struct Counter {
    std::int64_t tick_ns;
    std::uint32_t bits;
    bool is_signed;
};
class Wraps : public ::testing::TestWithParam<Counter> {};

TEST_P(Wraps, AreCountedOn) {
    const auto [tick_ns, bits, is_signed] = GetParam();
    const __int128 range = static_cast<__int128>(tick_ns) << bits;
    for (const bool in_ticks : {false, true}) {
        auto rows = good_rows(300, 0);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            // The wrap comes after 117 rows.
            __int128 at = range - (__int128{117} - static_cast<int>(i)) * kInterval - 1'234'567;
            if (is_signed) {
                at -= range / 2;
                at = at >= range / 2 ? at - range : at;
            } else {
                at = at >= range ? at - range : at;
            }
            rows[i].device_ticks = static_cast<std::int64_t>(in_ticks ? at / tick_ns : at);
        }
        const DeviceTimes times = device_times(rows, in_ticks ? static_cast<double>(tick_ns) : 1.0);
        EXPECT_EQ(times.rows.size(), 300U);
        ASSERT_TRUE(increases(times.time_ns));
        for (std::size_t i = 0; i < 300; ++i) {
            EXPECT_NEAR(static_cast<double>(times.time_ns[i]), static_cast<double>(i) * kInterval,
                        static_cast<double>(2 * tick_ns));
        }
        // Whole milliseconds share no time at 120 Hz.
        expect_one(times, TraceFindingKind::CounterWrapped, 2 + 118, 0);
    }
}

INSTANTIATE_TEST_SUITE_P(Counters, Wraps,
                         ::testing::Values(Counter{kUs, 32, false}, Counter{kMs, 32, false},
                                           Counter{100, 32, false}, Counter{1, 32, false},
                                           Counter{kUs, 32, true}, Counter{kMs, 32, true},
                                           Counter{100, 32, true}, Counter{kUs, 31, false},
                                           Counter{kMs, 16, false}));

TEST(DeviceTimes, CountOnOverAWrapThatRowsAreMixedUpAround) {
    auto rows = good_rows(300, (std::int64_t{1000} << 32) - 100 * kInterval);
    for (TraceRow& row : rows) {
        row.device_ticks = *row.device_ticks % (std::int64_t{1000} << 32);
    }
    std::swap(rows[99], rows[101]);
    const DeviceTimes times = device_times(rows, 1.0);
    EXPECT_EQ(times.rows.size(), 300U);
    EXPECT_EQ(times.time_ns.back(), 299 * kInterval);
    EXPECT_THAT(of_kind(times.findings, TraceFindingKind::CounterWrapped), SizeIs(1));
    EXPECT_THAT(of_kind(times.findings, TraceFindingKind::OutOfOrder), SizeIs(1));
    EXPECT_EQ(times.findings.size(), 2U);
}

TEST(DeviceTimes, GoOnByTheUsualIntervalWhereTheClockIsSet) {
    auto rows = good_rows(700);
    move_times(rows, 200, 700, -2 * kSecond);
    move_times(rows, 500, 700, -900 * kSecond);
    const DeviceTimes times = device_times(rows, 1.0);
    expect_good_but(times, 700, {});
    EXPECT_THAT(times.sets, ElementsAre(200, 500));
    const auto sets = of_kind(times.findings, TraceFindingKind::DeviceClockSet);
    ASSERT_THAT(sets, SizeIs(2));
    EXPECT_EQ(sets[0].line, 202U);
    EXPECT_EQ(sets[0].span_ns, -2 * kSecond);
    EXPECT_EQ(sets[1].span_ns, -900 * kSecond);
    EXPECT_EQ(times.findings.size(), 2U);
}

TEST(DeviceTimes, GoOnByTheHostsClockWhereTheDevicesIsSet) {
    for (const std::int64_t by : {-900 * kSecond, 900 * kSecond, -300 * kMs}) {
        auto rows = good_rows(600);
        move_times(rows, 300, 600, 40 * kMs);  // a gap, too
        rows = with_host(rows, 77 * kSecond);
        move_times(rows, 300, 600, by);
        const DeviceTimes times = device_times(rows, 1.0);
        EXPECT_EQ(times.rows.size(), 600U);
        EXPECT_EQ(times.time_ns[300] - times.time_ns[299], kInterval + 40 * kMs);
        EXPECT_THAT(times.sets, ElementsAre(300));
        expect_one(times, TraceFindingKind::DeviceClockSet, 302, 0);
        EXPECT_EQ(times.findings[0].span_ns, by);
    }
}

// ---- Order and repeats --------------------------------------------------------------------------

TEST(DeviceTimes, PutMixedUpRowsInOrder) {
    for (const bool numbered : {true, false}) {
        auto rows = good_rows(640);
        rows = numbered ? rows : without_sequence(rows);
        std::mt19937 random(7);
        for (std::size_t i = 0; i < 640; i += 64) {
            std::shuffle(rows.begin() + static_cast<std::ptrdiff_t>(i),
                         rows.begin() + static_cast<std::ptrdiff_t>(i) + 64, random);
        }
        const DeviceTimes times = device_times(rows, 1.0);
        ASSERT_EQ(times.rows.size(), 640U);
        for (std::size_t i = 0; i < 640; ++i) {
            EXPECT_EQ(times.time_ns[i], static_cast<std::int64_t>(i) * kInterval);
        }
        EXPECT_EQ(of_kind(times.findings, TraceFindingKind::OutOfOrder).size(),
                  times.findings.size());
    }
}

TEST(DeviceTimes, PutRowsInOrderThatMoveALittleAllAlong) {
    auto rows = without_sequence(good_rows(1000));
    std::mt19937 random(9);
    std::uniform_real_distribution<double> late(0.0, 4.0);
    std::vector<std::pair<double, TraceRow>> arrivals;
    arrivals.reserve(rows.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        arrivals.emplace_back(static_cast<double>(i) + late(random), rows[i]);
    }
    std::sort(arrivals.begin(), arrivals.end(),
              [](const auto& a, const auto& b) { return a.first < b.first; });
    std::transform(arrivals.begin(), arrivals.end(), rows.begin(),
                   [](const auto& arrival) { return arrival.second; });
    const DeviceTimes times = device_times(rows, 1.0);
    ASSERT_EQ(times.rows.size(), 1000U);
    EXPECT_EQ(times.time_ns.back(), 999 * kInterval);
    EXPECT_TRUE(increases(times.time_ns));
}

TEST(DeviceTimes, CountRowsThatMoved) {
    auto rows = good_rows(100);
    std::rotate(rows.begin() + 40, rows.begin() + 41, rows.begin() + 46);  // 40 goes behind 45
    const DeviceTimes times = device_times(rows, 1.0);
    EXPECT_EQ(times.time_ns.back(), 99 * kInterval);
    ASSERT_THAT(times.findings, SizeIs(1));
    EXPECT_EQ(times.findings[0].kind, TraceFindingKind::OutOfOrder);
    EXPECT_EQ(times.findings[0].rows, 1U);
    EXPECT_EQ(times.findings[0].line, 42U);
}

TEST(DeviceTimes, TurnAFileRoundThatRunsBackwards) {
    auto rows = good_rows(100);
    std::reverse(rows.begin(), rows.end());
    const DeviceTimes times = device_times(rows, 1.0);
    EXPECT_EQ(times.rows.front(), 99U);
    EXPECT_EQ(times.time_ns.back(), 99 * kInterval);
    ASSERT_THAT(times.findings, SizeIs(1));
    EXPECT_EQ(times.findings[0].kind, TraceFindingKind::OutOfOrder);
    EXPECT_EQ(times.findings[0].rows, 100U);
}

TEST(DeviceTimes, KeepTheOrderOfRowsThatCountUpWhileTimesGoDown) {
    auto rows = good_rows(100);
    for (TraceRow& row : rows) {
        row.device_ticks = 10 * kSecond - *row.device_ticks;
    }
    const DeviceTimes times = device_times(rows, 1.0);
    EXPECT_EQ(times.rows.size(), 100U);
    EXPECT_EQ(times.sets.size(), 99U);
    EXPECT_TRUE(increases(times.time_ns));
}

TEST(DeviceTimes, DropRepeatsNearAndFar) {
    for (const bool numbered : {true, false}) {
        auto rows = good_rows(100);
        rows = numbered ? rows : without_sequence(rows);
        rows.insert(rows.begin() + 51, rows[50]);
        rows.insert(rows.begin() + 80, rows[60]);
        const DeviceTimes times = device_times(rows, 1.0);
        EXPECT_EQ(times.rows.size(), 100U);
        EXPECT_EQ(times.time_ns.back(), 99 * kInterval);
        expect_one(times, TraceFindingKind::Repeat, 52, 2);
    }
}

// ---- Coarse clocks, and clocks that stand -------------------------------------------------------

TEST(DeviceTimes, SpreadRowsOverTheStepOfACoarseClock) {
    auto rows = good_rows(3000, 4 * kSecond, 500 * kUs);
    for (TraceRow& row : rows) {
        row.device_ticks = *row.device_ticks / kMs * kMs;
    }
    const DeviceTimes times = device_times(rows, 1.0);
    ASSERT_EQ(times.rows.size(), 3000U);
    for (std::size_t i = 0; i < 3000; ++i) {
        ASSERT_EQ(times.time_ns[i], static_cast<std::int64_t>(i) * 500 * kUs);
    }
    EXPECT_EQ(times.step_ns, std::vector<std::int64_t>(3000, kMs));
    EXPECT_EQ(times.interval_ns, 500 * kUs);
    ASSERT_THAT(times.findings, SizeIs(1));
    EXPECT_EQ(times.findings[0].kind, TraceFindingKind::CoarseTimes);
    EXPECT_EQ(times.findings[0].rows, 3000U);
    EXPECT_EQ(times.findings[0].dropped, 0U);
    EXPECT_EQ(times.findings[0].span_ns, kMs);
}

TEST(DeviceTimes, SpreadWholeMillisecondsOfAJitteringClock) {
    auto rows = without_sequence(good_rows(2000, 4 * kSecond, kMs));
    std::mt19937 random(3);
    std::uniform_int_distribution<std::int64_t> jitter(-400 * kUs, 400 * kUs);
    std::vector<std::int64_t> truth;
    for (TraceRow& row : rows) {
        truth.push_back(*row.device_ticks + jitter(random));
        row.device_ticks = truth.back() / kMs * kMs;
    }
    const DeviceTimes times = device_times(rows, 1.0);
    ASSERT_EQ(times.rows.size(), 2000U);
    EXPECT_TRUE(increases(times.time_ns));
    for (std::size_t i = 0; i < 2000; ++i) {
        const std::int64_t read = *rows[0].device_ticks + times.time_ns[i];
        EXPECT_LE(read / kMs, truth[i] / kMs);
        EXPECT_LT(std::abs(read - truth[i]), kMs) << i;
    }
    EXPECT_NEAR(static_cast<double>(times.interval_ns), 1e6, 1e4);
    ASSERT_THAT(times.findings, SizeIs(1));
    EXPECT_EQ(times.findings[0].kind, TraceFindingKind::CoarseTimes);
}

TEST(DeviceTimes, TakeClosedEyesOfACoarseClockForRowsOfTheirOwn) {
    auto rows = without_sequence(good_rows(300, 0, 500 * kUs));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].device_ticks = *rows[i].device_ticks / kMs * kMs;
        if (i >= 100 && i < 200) {
            rows[i].eyes = {};
        }
    }
    EXPECT_EQ(device_times(rows, 1.0).rows.size(), 300U);
}

TEST(DeviceTimes, SpreadRowsOfAClockThatStoodAndCaughtUp) {
    auto rows = good_rows(700);
    for (std::size_t i = 300; i < 420; ++i) {
        rows[i].device_ticks = rows[300].device_ticks;
    }
    const DeviceTimes times = device_times(rows, 1.0);
    ASSERT_EQ(times.rows.size(), 700U);
    EXPECT_THAT(times.sets, IsEmpty());
    for (std::size_t i = 0; i < 700; ++i) {
        EXPECT_NEAR(static_cast<double>(times.time_ns[i]), static_cast<double>(i) * kInterval, 2.0);
    }
    EXPECT_TRUE(times.reckoned[301]);
    EXPECT_FALSE(times.reckoned[420]);
    ASSERT_THAT(times.findings, SizeIs(1));
    EXPECT_EQ(times.findings[0].kind, TraceFindingKind::ClockStoodStill);
    EXPECT_EQ(times.findings[0].rows, 120U);
}

TEST(DeviceTimes, GoOnWhereAClockStoodAndNeverCaughtUp) {
    for (const bool timed : {false, true}) {
        auto rows = good_rows(700);
        rows = timed ? with_host(rows, 5 * kSecond) : rows;
        move_times(rows, 420, 700, -120 * kInterval);
        for (std::size_t i = 300; i < 420; ++i) {
            rows[i].device_ticks = rows[299].device_ticks;
        }
        const DeviceTimes times = device_times(rows, 1.0);
        ASSERT_EQ(times.rows.size(), 700U);
        EXPECT_THAT(times.sets, ElementsAre(420));
        EXPECT_TRUE(increases(times.time_ns));
        EXPECT_NEAR(static_cast<double>(times.time_ns.back()), 699.0 * kInterval, 2.0);
        ASSERT_THAT(times.findings, SizeIs(1));
        EXPECT_EQ(times.findings[0].kind, TraceFindingKind::ClockStoodStill);
        EXPECT_EQ(times.findings[0].rows, 121U);
    }
}

TEST(DeviceTimes, FollowTheHostWhereAllTimesAreEqual) {
    auto rows = with_host(good_rows(50), 0);
    for (TraceRow& row : rows) {
        row.device_ticks = 7;
    }
    const DeviceTimes times = device_times(rows, 1.0);
    EXPECT_NEAR(static_cast<double>(times.time_ns.back()), 49.0 * kInterval, 1.0);
    ASSERT_THAT(times.findings, SizeIs(1));
    EXPECT_EQ(times.findings[0].kind, TraceFindingKind::ClockStoodStill);
    for (TraceRow& row : rows) {
        row.host_ns.reset();
    }
    EXPECT_EQ(device_times(rows, 1.0).interval_ns, 0);
}

/// 1200 rows at 120 Hz of which the device's clock stands at 7, with host times that jitter.
std::vector<TraceRow> stood_rows() {
    auto rows = with_host(good_rows(1200), 90 * kSecond);
    std::mt19937 random(4);
    std::exponential_distribution<double> late(1e-6);
    for (TraceRow& row : rows) {
        row.device_ticks = 7;
        *row.host_ns += std::llround(late(random));
    }
    return rows;
}

void expect_near_truth(const DeviceTimes& times, std::size_t gap_at, std::int64_t gap_ns) {
    ASSERT_EQ(times.time_ns.size(), 1200U);
    for (std::size_t i = 0; i < 1200; ++i) {
        const std::int64_t truth =
            static_cast<std::int64_t>(i) * kInterval + (i >= gap_at ? gap_ns : 0);
        ASSERT_NEAR(static_cast<double>(times.time_ns[i]), static_cast<double>(truth), 0.3e6) << i;
    }
}

TEST(DeviceTimes, FollowTheHostsUsualIntervalWhereTheClockStands) {
    expect_near_truth(device_times(stood_rows(), 1.0), 1200, 0);
    for (const std::int64_t late : {400 * kMs, 3600 * kSecond, -3600 * kSecond}) {
        auto rows = stood_rows();
        *rows.back().host_ns += late;
        expect_near_truth(device_times(rows, 1.0), 1200, 0);
        rows.back().host_ns.reset();
        expect_near_truth(device_times(rows, 1.0), 1200, 0);
        *rows[600].host_ns += late;
        expect_near_truth(device_times(rows, 1.0), 1200, 0);
    }
}

TEST(DeviceTimes, FollowTheHostOverAGapWhereTheClockStands) {
    auto rows = stood_rows();
    for (std::size_t i = 500; i < 1200; ++i) {
        *rows[i].host_ns += 5 * kSecond;
    }
    expect_near_truth(device_times(rows, 1.0), 500, 5 * kSecond);
    rows = stood_rows();
    for (std::size_t i = 500; i < 1200; ++i) {
        *rows[i].host_ns -= 5 * kSecond;
    }
    expect_near_truth(device_times(rows, 1.0), 1200, 0);
}

TEST(DeviceTimes, CatchUpWithAGapThatWasWithinAStand) {
    auto rows = with_host(good_rows(1400), kSecond);
    rows.erase(rows.begin() + 700, rows.begin() + 1300);
    for (std::size_t i = 600; i < 750; ++i) {
        rows[i].device_ticks = rows[600].device_ticks;
    }
    const DeviceTimes times = device_times(rows, 1.0);
    expect_one(times, TraceFindingKind::ClockStoodStill, 602, 0);
    EXPECT_THAT(times.sets, IsEmpty());
    for (std::size_t i = 0; i < 800; ++i) {
        const std::int64_t truth = static_cast<std::int64_t>(i < 700 ? i : i + 600) * kInterval;
        ASSERT_NEAR(static_cast<double>(times.time_ns[i]), static_cast<double>(truth), 1e5) << i;
    }
}

TEST(DeviceTimes, FollowAHostThatReadsInBatchesWhereTheClockStands) {
    auto rows = stood_rows();
    for (std::size_t i = 0; i < 1200; ++i) {
        rows[i].host_ns = rows[i / 4 * 4 + 3].host_ns;
    }
    const DeviceTimes times = device_times(rows, 1.0);
    expect_near_truth(times, 1200, 0);
    EXPECT_NEAR(static_cast<double>(times.interval_ns), static_cast<double>(kInterval), 0.2e6);
}

TEST(DeviceTimes, BeginAndEndACoarseClockWithinItsSteps) {
    for (const std::int64_t start : {0, 3, 13}) {
        for (const std::size_t count : {2'990U, 2'997U, 3'000U}) {
            auto rows = without_sequence(good_rows(count, start * kMs, kMs));
            for (TraceRow& row : rows) {
                row.device_ticks = *row.device_ticks / (16 * kMs) * (16 * kMs);
            }
            const DeviceTimes times = device_times(rows, 1.0);
            ASSERT_EQ(times.rows.size(), count);
            for (std::size_t i = 0; i < count; ++i) {
                ASSERT_NEAR(static_cast<double>(times.time_ns[i]),
                            static_cast<double>(i) * static_cast<double>(kMs), 0.4e6)
                    << start << ' ' << count << ' ' << i;
            }
        }
    }
}

// ---- Few rows, absurd rows ----------------------------------------------------------------------

TEST(DeviceTimes, OfVeryFewRows) {
    EXPECT_THAT(device_times({}, 1.0).rows, IsEmpty());
    EXPECT_THAT(device_times(good_rows(1), 1.0).time_ns, ElementsAre(0));
    EXPECT_THAT(device_times(good_rows(2), 1.0).time_ns, ElementsAre(0, kInterval));
    const DeviceTimes three = device_times(good_rows(3), 1.0);
    EXPECT_THAT(three.time_ns, ElementsAre(0, kInterval, 2 * kInterval));
    EXPECT_THAT(three.findings, IsEmpty());
}

TEST(DeviceTimes, BearAnyReadings) {
    std::mt19937_64 random(11);
    for (const double tick_ns : {1e-3, 1.0, 100.0, 1e6, 1e30}) {
        auto rows = with_host(good_rows(500), 0);
        for (TraceRow& row : rows) {
            row.device_ticks = static_cast<std::int64_t>(random());
            row.host_ns = static_cast<std::int64_t>(random());
            row.sequence = random();
        }
        rows[7].device_ticks = std::numeric_limits<std::int64_t>::min();
        rows[8].device_ticks = std::numeric_limits<std::int64_t>::max();
        const DeviceTimes times = device_times(rows, tick_ns);
        EXPECT_EQ(times.time_ns.size(), times.rows.size());
    }
}

TEST(DeviceTimes, DropBurstsAtTheEndsThatNumbersContradict) {
    for (const std::size_t length : {2U, 16U}) {
        for (const std::size_t first : {std::size_t{0}, 2'000 - length}) {
            for (const std::int64_t by : {2'500 * kMs, -2'500 * kMs}) {
                auto rows = good_rows(2'000, 9 * kSecond, kMs);
                move_times(rows, first, first + length, by);
                const DeviceTimes times = device_times(rows, 1.0);
                EXPECT_EQ(times.rows.size(), 2'000 - length) << first << ' ' << by;
                expect_one(times, TraceFindingKind::TimeOutlier, first + 2, length);
            }
        }
    }
}

TEST(DeviceTimes, DropABurstOfManyRowsThatIsShort) {
    for (const std::size_t length : {20U, 48U, 49U}) {
        auto rows = good_rows(2'000, 9 * kSecond, kMs);
        move_times(rows, 800, 800 + length, 2'500 * kMs);
        EXPECT_EQ(device_times(rows, 1.0).rows.size(), length <= 48 ? 2'000 - length : 2'000);
    }
    auto rows = good_rows(2'000);
    move_times(rows, 800, 820, 2'500 * kMs);
    EXPECT_EQ(device_times(rows, 1.0).rows.size(), 2'000U);  // 167 ms
}

}  // namespace
}  // namespace gazeloop::drivers
