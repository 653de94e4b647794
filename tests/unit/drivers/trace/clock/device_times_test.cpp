#include "drivers/trace/clock/device_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <random>

#include "tests/unit/drivers/trace/clock/judged_times.h"
#include "tests/unit/drivers/trace/clock/trace_rows.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(DeviceTimes, OfAGoodTraceAreItsReadings) {
    const auto rows = good_rows(100);
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
    expect_good_but(times, 100, {});
    EXPECT_THAT(times.findings, IsEmpty());
    EXPECT_THAT(times.sets, IsEmpty());
    EXPECT_EQ(times.interval_ns, kInterval);
    EXPECT_EQ(times.reading_ns.front(), 3 * kSecond);
    EXPECT_EQ(times.step_ns, memory::LongVector<std::int64_t>(100, 0));
}

TEST(DeviceTimes, CountTicksOfOtherLengthsFromTheFirst) {
    const auto rows = good_rows(3, 638'342'794'000'115'346, 83'333);
    const DeviceTimes times = device_times(RowsRead{rows}, 100.0);
    EXPECT_THAT(times.time_ns, ElementsAre(0, 8'333'300, 16'666'600));
    EXPECT_EQ(times.reading_ns, times.time_ns);
    EXPECT_THAT(device_times(RowsRead{rows}, 100.5).time_ns, ElementsAre(0, 8'374'966, 16'749'933));
}

TEST(DeviceTimes, KeepGapsForward) {
    auto rows = without_sequence(good_rows(100));
    move_times(rows, 40, 100, kSecond);
    move_times(rows, 41, 100, kSecond);
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
            const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
            const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
        const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
        expect_good_but(times, 400, {0, 1, 2, 3, 4, 5, 6, 7, 8, 9});
        expect_one(times, TraceFindingKind::TimeOutlier, 2, 10);
    }
}

TEST(DeviceTimes, KeepALastRowThatTheHostVouchesFor) {
    auto rows = good_rows(100);
    move_times(rows, 99, 100, 5 * kSecond);
    rows = with_host(rows, 7 * kSecond);
    EXPECT_EQ(device_times(RowsRead{rows}, 1.0).rows.size(), 100U);
}

TEST(DeviceTimes, ReportRowsWithoutATime) {
    auto rows = good_rows(100);
    rows[0].device_ticks.reset();
    rows[50].device_ticks.reset();
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
    expect_good_but(times, 100, {0, 50});
    expect_one(times, TraceFindingKind::BadTime, 2, 2);
    for (TraceRow& row : rows) {
        row.device_ticks.reset();
    }
    EXPECT_THAT(device_times(RowsRead{rows}, 1.0).rows, IsEmpty());
    rows = with_host(good_rows(100), 0);
    for (TraceRow& row : rows) {
        row.device_ticks.reset();
    }
    const DeviceTimes by_host = device_times(RowsRead{rows}, 1.0);
    expect_good_but(by_host, 100, {});
    EXPECT_TRUE(by_host.by_host);
    expect_one(by_host, TraceFindingKind::BadTime, 2, 0);
}

// ---- Few rows, absurd rows ----------------------------------------------------------------------

TEST(DeviceTimes, OfVeryFewRows) {
    EXPECT_THAT(device_times({}, 1.0).rows, IsEmpty());
    EXPECT_THAT(device_times(RowsRead{good_rows(1)}, 1.0).time_ns, ElementsAre(0));
    EXPECT_THAT(device_times(RowsRead{good_rows(2)}, 1.0).time_ns, ElementsAre(0, kInterval));
    const DeviceTimes three = device_times(RowsRead{good_rows(3)}, 1.0);
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
        const DeviceTimes times = device_times(RowsRead{rows}, tick_ns);
        EXPECT_EQ(times.time_ns.size(), times.rows.size());
    }
}

TEST(DeviceTimes, DropBurstsAtTheEndsThatNumbersContradict) {
    for (const std::size_t length : {2U, 16U}) {
        for (const std::size_t first : {std::size_t{0}, 2'000 - length}) {
            for (const std::int64_t by : {2'500 * kMs, -2'500 * kMs}) {
                auto rows = good_rows(2'000, 9 * kSecond, kMs);
                move_times(rows, first, first + length, by);
                const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
        EXPECT_EQ(device_times(RowsRead{rows}, 1.0).rows.size(),
                  length <= 48 ? 2'000 - length : 2'000);
    }
    auto rows = good_rows(2'000);
    move_times(rows, 800, 820, 2'500 * kMs);
    EXPECT_EQ(device_times(RowsRead{rows}, 1.0).rows.size(), 2'000U);  // 167 ms
}

// ---- Counters of few bits -----------------------------------------------------------------------

/// A counter of 65.5 ms begins anew every eighth row at 120 Hz: only the host's clock tells how
/// often.
TEST(DeviceTimes, CountAShortCounterOnByTheHostsClock) {
    for (const std::int64_t gap_ns : {std::int64_t{0}, 300 * kMs}) {
        auto rows = with_host(good_rows(600), kSecond);
        std::mt19937_64 random(7);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::int64_t taken_ns = *rows[i].device_ticks + (i < 300 ? 0 : gap_ns);
            rows[i].device_ticks = taken_ns % 65'536'000 / kUs * kUs;
            rows[i].host_ns = taken_ns + kSecond + static_cast<std::int64_t>(random() % 4'000'000);
        }
        const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
        ASSERT_EQ(times.rows.size(), 600U);
        EXPECT_NEAR(static_cast<double>(times.time_ns[599]),
                    599.0 * 8'333'333.0 + static_cast<double>(gap_ns), 2e3);
        ASSERT_THAT(times.findings, SizeIs(1));
        EXPECT_EQ(times.findings[0].kind, TraceFindingKind::CounterWrapped);
        EXPECT_GE(times.findings[0].rows, 70U);
        EXPECT_EQ(times.findings[0].dropped, 0U);
    }
}

TEST(DeviceTimes, CountACounterOfTwentyBitsOnFromTheFirstRow) {
    for (const bool host : {true, false}) {
        auto rows = host ? with_host(good_rows(700, 0), kSecond) : good_rows(700, 0);
        for (TraceRow& row : rows) {
            row.device_ticks = (*row.device_ticks / kUs + (1 << 20) - 100'000) % (1 << 20) * kUs;
        }
        const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
        ASSERT_EQ(times.rows.size(), 700U) << host;
        EXPECT_NEAR(static_cast<double>(times.time_ns[699]), 699.0 * 8'333'333.0, 2e3);
        EXPECT_THAT(of_kind(times.findings, TraceFindingKind::TimeOutlier), IsEmpty());
    }
}

}  // namespace
}  // namespace gazeloop::drivers
