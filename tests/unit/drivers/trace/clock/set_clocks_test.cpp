// A device's clock that wraps or is set.
#include "drivers/trace/clock/device_times.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/drivers/trace/clock/judged_times.h"
#include "tests/unit/drivers/trace/clock/trace_rows.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using ::testing::ElementsAre;
using ::testing::SizeIs;

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
        const DeviceTimes times =
            device_times(RowsRead{rows}, in_ticks ? static_cast<double>(tick_ns) : 1.0);
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

TEST(DeviceTimes, KeepAGapInWhichTheCounterWraps) {
    constexpr std::int64_t kGap = 3 * kSecond;
    constexpr std::int64_t kRange = kUs << 32;
    for (const bool with_host : {false, true}) {
        auto rows = good_rows(300, 0);
        for (std::size_t i = 0; i < rows.size(); ++i) {
            const std::int64_t since =
                static_cast<std::int64_t>(i) * kInterval + (i < 150 ? 0 : kGap - kInterval);
            rows[i].device_ticks = (kRange - 150 * kInterval - kGap / 2 + since) % kRange;
            if (with_host) {
                rows[i].host_ns = 77 * kSecond + since;
            }
        }
        const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
        EXPECT_EQ(times.rows.size(), 300U);
        EXPECT_EQ(times.time_ns[150] - times.time_ns[149], kGap);
        expect_one(times, TraceFindingKind::CounterWrapped, 2 + 150, 0);
    }
}

TEST(DeviceTimes, SayThatAGapsLengthIsNotKnownWhereClockAndNumbersBeginAnew) {
    auto rows = without_sequence(good_rows(300));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].sequence = i < 150 ? i : i - 150;
        rows[i].device_ticks = rows[i < 150 ? i : i - 150].device_ticks;
    }
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
    const auto sets = of_kind(times.findings, TraceFindingKind::DeviceClockSet);
    ASSERT_THAT(sets, SizeIs(1));
    EXPECT_THAT(sets[0].text, ::testing::HasSubstr("its report numbers begin anew (the tracker was "
                                                   "restarted, or another recording follows"));
    EXPECT_THAT(sets[0].text, ::testing::HasSubstr("how long it really was is not known"));
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
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
    const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
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
        const DeviceTimes times = device_times(RowsRead{rows}, 1.0);
        EXPECT_EQ(times.rows.size(), 600U);
        EXPECT_EQ(times.time_ns[300] - times.time_ns[299], kInterval + 40 * kMs);
        EXPECT_THAT(times.sets, ElementsAre(300));
        expect_one(times, TraceFindingKind::DeviceClockSet, 302, 0);
        EXPECT_EQ(times.findings[0].span_ns, by);
    }
}

}  // namespace
}  // namespace gazeloop::drivers
