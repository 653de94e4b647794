#include "drivers/trace/trace_builder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/drivers/trace/built_traces.h"
#include "tests/unit/drivers/trace/clock/trace_rows.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::StartsWith;

Expected<gaze::GazeTrace> built(const std::vector<TraceRow>& rows,
                                const ReadOptions& options = {}) {
    TraceBuilder builder({"gaze.csv", "gazeloop", "a tracker", 1.0});
    for (const TraceRow& row : rows) {
        builder.add(row);
    }
    return all_of(builder.finish(options));
}

std::string refusal(const std::vector<TraceRow>& rows) {
    const Expected<gaze::GazeTrace> trace = built(rows);
    return trace ? "accepted" : trace.error().message;
}

TEST(TraceBuilder, MakesATraceOfGoodRows) {
    const gaze::GazeTrace trace = value_or_throw(built(with_host(good_rows(100), kSecond)));
    EXPECT_EQ(trace.file, "gaze.csv");
    EXPECT_EQ(trace.format, "gazeloop");
    EXPECT_EQ(trace.device, "a tracker");
    ASSERT_EQ(trace.samples.size(), 100U);
    EXPECT_EQ(trace.samples[99].sequence, 99U);
    EXPECT_EQ(trace.samples[99].sampled,
              (time::Stamp{std::int64_t{99} * 8'333'333, time::StampKind::Modelled}));
    EXPECT_EQ(trace.samples[99].arrived, trace.samples[99].sampled);
    EXPECT_EQ(trace.samples[99].device_ns, 3 * kSecond + 99 * 8'333'333);
    EXPECT_FALSE(trace.samples[99].uncertainty_ns.has_value());
    EXPECT_THAT(trace.report.findings(), IsEmpty());
    EXPECT_EQ(trace.report.rows, 100U);
    EXPECT_EQ(trace.report.valid[0], 100U);
    EXPECT_NEAR(trace.report.rate_hz, 120.0, 1e-5);
    EXPECT_EQ(trace.report.longest_gap_ns, 8'333'333);
}

TEST(TraceBuilder, TellsTheThreeFiguresApart) {
    auto rows = good_rows(800);
    move_times(rows, 300, 301, 2'500 * kMs);             // dropped here
    rows.erase(rows.begin() + 400, rows.begin() + 405);  // lost by the tracker
    std::swap(rows[600], rows[601]);                     // out of order
    const gaze::GazeTrace trace = value_or_throw(built(rows));
    EXPECT_EQ(trace.samples.size(), 794U);
    EXPECT_EQ(trace.report.lost_by_tracker, 5U);
    EXPECT_EQ(trace.report.rows_dropped(), 1U);
    EXPECT_EQ(trace.report.count(TraceFindingKind::TimeOutlier).dropped, 1U);
    EXPECT_EQ(trace.report.count(TraceFindingKind::OutOfOrder).rows, 1U);
    EXPECT_EQ(trace.report.count(TraceFindingKind::OutOfOrder).dropped, 0U);
}

TEST(TraceBuilder, ReadsATraceAsOnceMore) {
    // A 32-bit counter of microseconds wraps, the sequence does too, and a row is stamped ahead.
    auto rows = with_host(good_rows(700, 0), 50 * kSecond);
    const std::int64_t range = std::int64_t{1000} << 32;
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].device_ticks = (*rows[i].device_ticks + range - 900 * kMs) % range;
        rows[i].sequence = (i + 4'294'967'000U) % (std::uint64_t{1} << 32);
    }
    *rows[20].device_ticks += 2'500 * kMs;
    const gaze::GazeTrace trace = value_or_throw(built(rows));
    EXPECT_EQ(trace.samples.size(), 699U);
    EXPECT_EQ(trace.report.lost_by_tracker, 0U);
    EXPECT_EQ(trace.report.count(TraceFindingKind::CounterWrapped).times, 1U);
    EXPECT_EQ(trace.report.count(TraceFindingKind::SequenceRestarted).times, 1U);
    EXPECT_EQ(trace.report.count(TraceFindingKind::TimeOutlier).times, 1U);
    EXPECT_EQ(trace.samples.back().sampled.ns, 699 * std::int64_t{8'333'333});
}

TEST(TraceBuilder, RefusesWhatIsMostlyDropped) {
    auto rows = good_rows(100);
    for (std::size_t i = 5; i < 100; i += 8) {
        move_times(rows, i, i + 1, 300 * kSecond);
    }
    EXPECT_EQ(
        refusal(rows),
        "gaze.csv:7: 12 of 100 rows cannot be used (time outlier 12), the first of them here; "
        "--accept-repairs plays the others");
    const gaze::GazeTrace trace = value_or_throw(built(rows, {.accept_repairs = true}));
    EXPECT_EQ(trace.samples.size(), 88U);
    EXPECT_EQ(trace.report.rows_dropped(), 12U);
}

TEST(TraceBuilder, RefusesAClockThatNeverGoesForward) {
    auto rows = good_rows(100);
    for (TraceRow& row : rows) {
        row.device_ticks = 10 * kSecond - *row.device_ticks;
    }
    EXPECT_THAT(refusal(rows),
                StartsWith("gaze.csv:3: the clocks step back or ahead in 99 of 100"));
    EXPECT_EQ(value_or_throw(built(rows, {.accept_repairs = true})).samples.size(), 100U);
}

TEST(TraceBuilder, RefusesAGapLongerThanTheRest) {
    auto rows = without_sequence(good_rows(600));
    move_times(rows, 300, 600, 3600 * kSecond);
    EXPECT_EQ(refusal(rows),
              "gaze.csv:302: 3600.01 s without a row, longer than all the rest of the recording, "
              "4.98333 s; --accept-repairs plays it as 10 s");
    const gaze::GazeTrace trace =
        value_or_throw(built(rows, {.accept_repairs = true, .longest_gap_s = 2.0}));
    EXPECT_EQ(trace.samples.size(), 600U);
    EXPECT_EQ(trace.samples[300].sampled.ns - trace.samples[299].sampled.ns, 2 * kSecond);
    EXPECT_EQ(trace.samples[301].sampled.ns - trace.samples[300].sampled.ns, 8'333'333);
    EXPECT_EQ(trace.report.count(TraceFindingKind::GapShortened).times, 1U);
    EXPECT_EQ(trace.report.count(TraceFindingKind::GapShortened).span_ns,
              3598 * kSecond + 8'333'333);
    EXPECT_EQ(trace.report.longest_gap_ns, 3600 * kSecond + 8'333'333);
}

TEST(TraceBuilder, ShortensGapsOfALongTrace) {
    auto rows = with_host(good_rows(6'000), 0);  // 50 s
    for (std::size_t i = 3'000; i < 6'000; ++i) {
        *rows[i].device_ticks += 20 * kSecond;
        *rows[i].host_ns += 20 * kSecond;
    }
    const gaze::GazeTrace trace = value_or_throw(built(rows));
    EXPECT_EQ(trace.samples[3'000].sampled.ns - trace.samples[2'999].sampled.ns, 10 * kSecond);
    EXPECT_EQ(trace.samples[3'000].arrived, trace.samples[3'000].sampled);
    EXPECT_EQ(trace.report.count(TraceFindingKind::GapShortened).times, 1U);
}

TEST(TraceBuilder, RefusesWhatHasNoTimes) {
    EXPECT_EQ(refusal({}), "gaze.csv: no rows after the header");
    auto rows = good_rows(5);
    for (TraceRow& row : rows) {
        row.device_ticks = 9;
    }
    EXPECT_EQ(
        refusal(rows),
        "gaze.csv:2: all 5 rows have the same time, and no host time says how long they took");
    for (TraceRow& row : rows) {
        row.device_ticks.reset();
    }
    EXPECT_EQ(refusal(rows), "gaze.csv:2: no row has a readable time");
}

TEST(TraceBuilder, RefusesWhatHasNoValidEye) {
    auto rows = good_rows(5);
    for (TraceRow& row : rows) {
        row.eyes = {};
    }
    EXPECT_EQ(refusal(rows), "no valid gaze in gaze.csv");
}

TEST(TraceBuilder, TakesVeryFewRows) {
    EXPECT_EQ(value_or_throw(built(good_rows(1))).samples.size(), 1U);
    EXPECT_EQ(value_or_throw(built(good_rows(3))).samples.size(), 3U);
}

TEST(TraceBuilder, SaysHowCoarseTimesAre) {
    auto rows = good_rows(3'000, 4 * kSecond, 500 * kUs);
    for (TraceRow& row : rows) {
        row.device_ticks = *row.device_ticks / kMs * kMs;
    }
    const gaze::GazeTrace trace = value_or_throw(built(rows));
    ASSERT_EQ(trace.samples.size(), 3'000U);
    EXPECT_EQ(trace.samples[7].uncertainty_ns, kMs);
    EXPECT_EQ(trace.report.lost_by_tracker, 0U);
    EXPECT_NEAR(trace.report.rate_hz, 2000.0, 1e-6);
}

TEST(TraceBuilder, CountsWhatItsReaderFindsToo) {
    TraceBuilder builder({"gaze.csv", "gazeloop", "a tracker", 1.0});
    for (const TraceRow& row : good_rows(8)) {
        builder.add(row);
    }
    builder.report().rows += 1;
    builder.report().add({.kind = TraceFindingKind::CutRow,
                          .line = 10,
                          .rows = 1,
                          .dropped = 1,
                          .span_ns = 0,
                          .text = "cut"});
    const gaze::GazeTrace trace = value_or_throw(all_of(builder.finish({})));
    EXPECT_EQ(trace.report.rows, 9U);
    EXPECT_EQ(trace.report.rows_dropped(), 1U);
}

TEST(TraceBuilder, DoesNotRefuseForACutLineButForTheRest) {
    const auto refusal_with = [](std::uint64_t cut, std::uint64_t repeats) {
        TraceBuilder builder({"gaze.csv", "gazeloop", "a tracker", 1.0});
        for (const TraceRow& row : good_rows(8)) {
            builder.add(row);
        }
        builder.report().rows += cut + repeats;
        builder.report().add({.kind = TraceFindingKind::CutRow,
                              .line = 9,
                              .rows = cut,
                              .dropped = cut,
                              .text = "cut"});
        builder.report().add({.kind = TraceFindingKind::Repeat,
                              .line = 4,
                              .rows = repeats,
                              .dropped = repeats,
                              .text = "again"});
        const Expected<gaze::GazeTrace> trace = all_of(builder.finish({}));
        return trace ? "accepted" : trace.error().message;
    };
    EXPECT_EQ(refusal_with(1, 0), "accepted");
    EXPECT_THAT(refusal_with(1, 1),
                StartsWith("gaze.csv:4: 1 of 9 rows cannot be used (repeat 1), the first"));
}

TEST(TraceBuilder, SaysWhatStandsInPlaceOfATime) {
    const auto refusal_of = [](std::vector<TraceRow> rows, bool host) {
        TraceBuilder builder({"gaze.csv", "gazeloop", "a tracker", 1.0});
        builder.unread_time("column 't': 'x' is no whole number of nanoseconds");
        builder.unread_time("column 't': 'y' is no whole number of nanoseconds");
        for (TraceRow& row : rows) {
            row.host_ns =
                host ? std::optional{static_cast<std::int64_t>(row.line) * kMs} : std::nullopt;
            builder.add(row);
        }
        const Expected<gaze::GazeTrace> trace = all_of(builder.finish({}));
        return trace ? trace->report.findings().at(0).text : trace.error().message;
    };
    auto rows = good_rows(10);
    for (std::size_t i = 3; i < 10; ++i) {
        rows[i].device_ticks.reset();
    }
    EXPECT_EQ(refusal_of(rows, false),
              "gaze.csv:5: column 't': 'x' is no whole number of nanoseconds; 7 rows without a "
              "readable time: dropped; mend the column, or --accept-repairs leaves these "
              "rows out");
    for (TraceRow& row : rows) {
        row.device_ticks.reset();
    }
    EXPECT_EQ(refusal_of(rows, false),
              "gaze.csv:2: no row has a readable time: column 't': 'x' is no whole number of "
              "nanoseconds");
    EXPECT_EQ(
        refusal_of(rows, true),
        "column 't': 'x' is no whole number of nanoseconds; no row has a readable time of the "
        "device's clock: times are the host's, at arrival");
}

TEST(TraceBuilder, TakesTheOtherClockWhereTheFirstIsUnreadable) {
    const auto of = [](const std::vector<TraceRow>& rows) {
        TraceBuilder builder({.file = "gaze.csv",
                              .format = "f",
                              .device = "d",
                              .device_tick_ns = 100.0,
                              .other_tick_ns = 1e6,
                              .other_clock = "ms"});
        builder.unread_time("column 't': 'x' is no whole number of 100 ns");
        for (const TraceRow& row : rows) {
            builder.add(row);
        }
        return all_of(builder.finish({}));
    };
    auto rows = good_rows(50);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].device_ticks.reset();
        rows[i].other_ticks = 70 + 8 * static_cast<std::int64_t>(i);
    }
    const gaze::GazeTrace trace = value_or_throw(of(rows));
    ASSERT_EQ(trace.samples.size(), 50U);
    EXPECT_EQ(trace.samples[49].sampled.ns, 49 * 8 * kMs);
    ASSERT_EQ(trace.report.findings().size(), 1U);
    EXPECT_EQ(trace.report.findings()[0].kind, TraceFindingKind::BadTime);
    EXPECT_EQ(trace.report.findings()[0].dropped, 0U);
    EXPECT_EQ(trace.report.findings()[0].text,
              "column 't': 'x' is no whole number of 100 ns, nor is it in any row: the times are "
              "those of 'ms'");
    for (TraceRow& row : rows) {
        row.other_ticks = -1;  // as SRanipal writes it where it has none
    }
    EXPECT_THAT(of(rows).error().message, HasSubstr("no row has a readable time"));
    for (const std::int64_t stuck : {std::int64_t{0}, std::int64_t{638'500'000'000'000'000}}) {
        for (std::size_t i = 0; i < rows.size(); ++i) {
            rows[i].device_ticks = stuck;
            rows[i].other_ticks = 70 + 8 * static_cast<std::int64_t>(i);
        }
        const gaze::GazeTrace other = value_or_throw(of(rows));
        ASSERT_EQ(other.samples.size(), 50U);
        EXPECT_EQ(other.samples[49].sampled.ns, 49 * 8 * kMs);
        ASSERT_EQ(other.report.findings().size(), 1U);
        EXPECT_THAT(other.report.findings()[0].text, HasSubstr("says the same in all rows"));
    }
}

TEST(TraceBuilder, KeepsAGapWhereTheDevicesClockStands) {
    auto rows = with_host(good_rows(1800), kSecond);
    rows.erase(rows.begin() + 500, rows.begin() + 1100);
    for (TraceRow& row : rows) {
        row.device_ticks = 7;
    }
    const gaze::GazeTrace trace = value_or_throw(built(rows));
    EXPECT_EQ(trace.report.lost_by_tracker, 600U);
    EXPECT_NEAR(static_cast<double>(trace.report.longest_gap_ns), 601 * 8'333'333.0, 1e6);
}

TEST(TraceBuilder, RefusesTimesOfAWrongUnit) {
    auto rows = with_host(good_rows(500), kSecond);
    for (TraceRow& row : rows) {
        *row.device_ticks /= 1000;
    }
    EXPECT_THAT(refusal(rows), HasSubstr("gaze.csv:2: the host's clock goes 1000 times as fast as "
                                         "the device's"));
    EXPECT_THAT(refusal(rows), HasSubstr("give the times of both clocks in nanoseconds"));
    ReadOptions options;
    options.accept_repairs = true;
    EXPECT_EQ(value_or_throw(built(rows, options)).report.count(TraceFindingKind::ClockRates).times,
              1U);
}

TEST(TraceBuilder, DoubtsRatesThatNoEyeTrackerHas) {
    const auto report_of = [](std::int64_t interval_ns, std::size_t count = 100) {
        TraceBuilder builder({"gaze.csv", "gazeloop", "a tracker", 1.0});
        builder.clock_is("t_device_ns", 1.0);
        for (const TraceRow& row : good_rows(count, 0, interval_ns)) {
            builder.add(row);
        }
        return value_or_throw(all_of(builder.finish({}))).report;
    };
    for (const std::int64_t usual_ns : {250 * kUs, 8'333 * kUs, 190 * kMs}) {
        EXPECT_EQ(report_of(usual_ns).count(TraceFindingKind::OddTimes).times, 0U) << usual_ns;
    }
    EXPECT_EQ(report_of(8, 15).count(TraceFindingKind::OddTimes).times, 0U) << "too few to tell";
    const gaze::TraceReport in_ms = report_of(8);
    EXPECT_TRUE(in_ms.worth_a_warning());
    ASSERT_EQ(in_ms.count(TraceFindingKind::OddTimes).times, 1U);
    EXPECT_EQ(
        in_ms.findings().back().text,
        "1.25e+08 rows a second by 't_device_ns', and eye trackers have 5 to 5000: they would "
        "be 125 in milliseconds; write the times in nanoseconds");
    EXPECT_THAT(report_of(8'333).findings().back().text, HasSubstr("120 in microseconds"));
    // Longer than the longest gap that is played.
    const gaze::TraceReport far = report_of(8'333 * kSecond);
    ASSERT_EQ(far.count(TraceFindingKind::OddTimes).times, 1U);
    EXPECT_THAT(far.findings().back().text, HasSubstr("0.00012 rows a second by 't_device_ns'"));
}

}  // namespace
}  // namespace gazeloop::drivers
