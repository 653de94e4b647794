// Rows in another order than their times, and rows that stand there twice.
#include "drivers/trace/clock/device_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/unit/drivers/trace/clock/judged_times.h"
#include "tests/unit/drivers/trace/clock/trace_rows.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using ::testing::SizeIs;

TEST(DeviceTimes, PutMixedUpRowsInOrder) {
    for (const bool numbered : {true, false}) {
        auto rows = good_rows(640);
        rows = numbered ? rows : without_sequence(rows);
        std::mt19937 random(7);
        for (std::size_t i = 0; i < 640; i += 64) {
            std::shuffle(rows.begin() + static_cast<std::ptrdiff_t>(i),
                         rows.begin() + static_cast<std::ptrdiff_t>(i) + 64, random);
        }
        const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
    ASSERT_EQ(times.rows.size(), 1000U);
    EXPECT_EQ(times.time_ns.back(), 999 * kInterval);
    EXPECT_TRUE(increases(times.time_ns));
}

TEST(DeviceTimes, CountRowsThatMoved) {
    auto rows = good_rows(100);
    std::rotate(rows.begin() + 40, rows.begin() + 41, rows.begin() + 46);  // 40 goes behind 45
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
    EXPECT_EQ(times.time_ns.back(), 99 * kInterval);
    ASSERT_THAT(times.findings, SizeIs(1));
    EXPECT_EQ(times.findings[0].kind, TraceFindingKind::OutOfOrder);
    EXPECT_EQ(times.findings[0].rows, 1U);
    EXPECT_EQ(times.findings[0].line, 42U);
}

TEST(DeviceTimes, TurnAFileRoundThatRunsBackwards) {
    auto rows = good_rows(100);
    std::reverse(rows.begin(), rows.end());
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
        const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
        EXPECT_EQ(times.rows.size(), 100U);
        EXPECT_EQ(times.time_ns.back(), 99 * kInterval);
        expect_one(times, TraceFindingKind::Repeat, 52, 2);
    }
}

}  // namespace
}  // namespace gazeloop::drivers
