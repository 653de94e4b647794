// Clocks that count in coarse steps, and clocks that stand.
#include "drivers/trace/clock/device_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/drivers/trace/clock/judged_times.h"
#include "tests/unit/drivers/trace/clock/trace_rows.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(DeviceTimes, SpreadRowsOverTheStepOfACoarseClock) {
    auto rows = good_rows(3000, 4 * kSecond, 500 * kUs);
    for (TraceRow& row : rows) {
        row.device_ticks = *row.device_ticks / kMs * kMs;
    }
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
    ASSERT_EQ(times.rows.size(), 3000U);
    for (std::size_t i = 0; i < 3000; ++i) {
        ASSERT_EQ(times.time_ns[i], static_cast<std::int64_t>(i) * 500 * kUs);
    }
    EXPECT_EQ(times.step_ns, memory::LongVector<std::int64_t>(3000, kMs));
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
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
    EXPECT_EQ(device_times(RowsRead{rows}, 1.0).rows.size(), 300U);
}

TEST(DeviceTimes, SpreadRowsOfAClockThatStoodAndCaughtUp) {
    auto rows = good_rows(700);
    for (std::size_t i = 300; i < 420; ++i) {
        rows[i].device_ticks = rows[300].device_ticks;
    }
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
        const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
    EXPECT_NEAR(static_cast<double>(times.time_ns.back()), 49.0 * kInterval, 1.0);
    ASSERT_THAT(times.findings, SizeIs(1));
    EXPECT_EQ(times.findings[0].kind, TraceFindingKind::ClockStoodStill);
    for (TraceRow& row : rows) {
        row.host_ns.reset();
    }
    EXPECT_EQ(device_times(RowsRead{rows}, 1.0).interval_ns, 0);
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
    expect_near_truth(device_times(RowsRead{stood_rows()}, 1.0), 1200, 0);
    for (const std::int64_t late : {400 * kMs, 3600 * kSecond, -3600 * kSecond}) {
        auto rows = stood_rows();
        *rows.back().host_ns += late;
        expect_near_truth(device_times(RowsRead{rows}, 1.0), 1200, 0);
        rows.back().host_ns.reset();
        expect_near_truth(device_times(RowsRead{rows}, 1.0), 1200, 0);
        *rows[600].host_ns += late;
        expect_near_truth(device_times(RowsRead{rows}, 1.0), 1200, 0);
    }
}

TEST(DeviceTimes, FollowTheHostOverAGapWhereTheClockStands) {
    auto rows = stood_rows();
    for (std::size_t i = 500; i < 1200; ++i) {
        *rows[i].host_ns += 5 * kSecond;
    }
    expect_near_truth(device_times(RowsRead{rows}, 1.0), 500, 5 * kSecond);
    rows = stood_rows();
    for (std::size_t i = 500; i < 1200; ++i) {
        *rows[i].host_ns -= 5 * kSecond;
    }
    expect_near_truth(device_times(RowsRead{rows}, 1.0), 1200, 0);
}

TEST(DeviceTimes, CatchUpWithAGapThatWasWithinAStand) {
    auto rows = with_host(good_rows(1400), kSecond);
    rows.erase(rows.begin() + 700, rows.begin() + 1300);
    for (std::size_t i = 600; i < 750; ++i) {
        rows[i].device_ticks = rows[600].device_ticks;
    }
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
            const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
            ASSERT_EQ(times.rows.size(), count);
            for (std::size_t i = 0; i < count; ++i) {
                ASSERT_NEAR(static_cast<double>(times.time_ns[i]),
                            static_cast<double>(i) * static_cast<double>(kMs), 0.4e6)
                    << start << ' ' << count << ' ' << i;
            }
        }
    }
}

}  // namespace
}  // namespace gazeloop::drivers
