#include "runtime/report/frame_log.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <sstream>
#include <string>

#include "runtime/latency/summary_observer.h"
#include "runtime/report/budget_gate.h"
#include "runtime/report/frame_csv.h"
#include "runtime/report/row_names.h"
#include "runtime/report/session_rows.h"
#include "runtime/report/summary_rows.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::report {
namespace {

using latency::example_frame;
using latency::example_gpu;
using latency::kMs;
using ::testing::ElementsAre;
using ::testing::HasSubstr;

latency::SummaryConfig example_config() {
    return {.period_ns = latency::kExamplePeriodNs,
            .switching_ns = 2 * kMs,
            .passes = latency::kExamplePasses,
            .grids = latency::kExampleGrids};
}

/// Frames of many kinds: late, lost, not rendered, with a gap, without GPU part.
template <typename Tell>
void tell_example(const Tell& tell) {
    for (std::uint64_t index = 0; index < 240; ++index) {
        if (index == 100) {
            continue;
        }
        frame::FrameRecord frame = example_frame(index);
        frame.should_render = index % 31 != 5;
        const bool held = index % 17 == 3;
        const bool ahead = index % 19 == 4;
        for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
            eye.state = ahead  ? gaze::FoveaState::Ahead
                        : held ? gaze::FoveaState::Held
                               : gaze::FoveaState::Tracking;
            eye.sampled.ns -= static_cast<std::int64_t>(index % 13) * kMs / 8;
            if (index % 23 == 6) {
                eye.sampled = {};
            }
        }
        std::optional<frame::FrameGpuRecord> gpu;
        if (index % 29 != 7) {
            gpu = example_gpu(index, index % 11 == 8 ? 12 : 4);
        }
        tell(frame, gpu);
    }
}

void tell(frame::FrameObserver& observer) {
    tell_example([&](const frame::FrameRecord& frame, const auto& gpu) {
        observer.on_frame(frame);
        if (gpu) {
            observer.on_gpu(*gpu);
        }
    });
}

TEST(FrameLog, SaysWhatTheSummarySays) {
    for (const std::int64_t period : {latency::kExamplePeriodNs, 7 * kMs}) {
        latency::SummaryConfig config = example_config();
        config.period_ns = period;  // with 7 ms the display is not the profile's
        latency::LatencySummary summary(config);
        latency::SummaryObserver observer(summary);
        tell(observer);
        const latency::SummaryReport report = summary.report();
        FrameLog log(config);
        tell(log);
        log.finish();
        const auto expect_alike = [&](const RowName& name, const latency::DurationRow& row) {
            const DurationColumn& column = log.at(name.key);
            EXPECT_EQ(column.known(), row.count) << name.key;
            EXPECT_EQ(column.frames_by_kind(), row.frames_by_kind) << name.key;
            const auto ms = [](const auto& ns) {
                return ns ? std::optional(static_cast<double>(*ns) / 1e6) : std::nullopt;
            };
            EXPECT_EQ(ms(column.least()), row.min_ms) << name.key;
            EXPECT_EQ(ms(column.greatest()), row.max_ms) << name.key;
            EXPECT_EQ(ms(column.mean()), row.mean_ms) << name.key;
            EXPECT_EQ(column.size(), log.rows()) << name.key;
        };
        expect_alike(kGazeAgeAtLatch, report.gaze_age_at_latch);
        expect_alike(kGazeAgeReadAtBegin, report.gaze_age_read_at_begin);
        expect_alike(kGazeAgeAtDisplay, report.gaze_age_at_display);
        expect_alike(kGazeAgeUncertainty, report.gaze_age_uncertainty);
        for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
            expect_alike(stage_name(stage), report.stages[stage]);
        }
        expect_alike(kUnaccounted, report.unaccounted);
        expect_alike(kHeldGazeAge, report.held_gaze_age_at_display);
        expect_alike(kFrameInterval, report.frame_interval);
        expect_alike(kLoopTime, report.loop_time);
        EXPECT_EQ(log.rows(), report.frames.total);
        EXPECT_EQ(log.at(kPeriodsMissed.key).known(),
                  report.frames.rendered - report.frames.in_time_unknown);
        EXPECT_EQ(log.at(kSamplesShaded.key).known(), report.frames.rendered);
    }
}

TEST(FrameLog, GivesTheSummaryExactPercentiles) {
    const latency::SummaryConfig config = example_config();
    latency::LatencySummary summary(config);
    FrameLog log(config);
    constexpr std::int64_t kStep_ns = 12'347;
    for (std::uint64_t index = 0; index < 300; ++index) {
        frame::FrameRecord frame = example_frame(index);
        frame.stamps.display.ns += static_cast<std::int64_t>(index) * kStep_ns;
        summary.add(frame);
        summary.add(example_gpu(index));
        log.on_frame(frame);
        log.on_gpu(example_gpu(index));
    }
    log.finish();
    latency::SummaryReport report = summary.report();
    const double rough = report.gaze_age_at_display.p95_ms.value();
    take_exact_percentiles(log, report);
    const double first = 1e-6 * static_cast<double>(*log.at(kGazeAgeAtDisplay.key).at(0));
    // The 285th of 300 in order.
    const double exact = first + 284 * 1e-6 * static_cast<double>(kStep_ns);
    EXPECT_NEAR(*report.gaze_age_at_display.p95_ms, exact, 1e-9);
    EXPECT_GT(std::abs(rough - exact), 1e-4);
    // So a limit between the two is judged by the frames.
    latency::LatencyBudget budget{.name = "test", .description = {}, .source = {}};
    budget.total_ns = std::llround(1e6 * exact);
    EXPECT_TRUE(budget_gate(report, budget).result());
    budget.total_ns = *budget.total_ns - 1;
    EXPECT_FALSE(budget_gate(report, budget).result());
}

TEST(FrameLog, AddsUpInEachFrame) {
    FrameLog log(example_config());
    tell(log);
    log.finish();
    std::size_t known = 0;
    for (std::size_t row = 0; row < log.rows(); ++row) {
        const auto age = log.at(kGazeAgeAtDisplay.key).at(row);
        if (!age) {
            continue;
        }
        std::int64_t sum = *log.at(kUnaccounted.key).at(row);
        for (std::size_t stage = 0; stage < latency::kStageCount; ++stage) {
            sum += log.at(stage_name(stage).key).at(row).value_or(0);
        }
        EXPECT_EQ(sum, *age) << "frame " << log.number(row);
        ++known;
    }
    EXPECT_GT(known, 100U);
}

TEST(FrameLog, FindsTheWorstFrames) {
    FrameLog log(example_config());
    for (std::uint64_t index = 5; index < 50; ++index) {
        log.on_frame(example_frame(index));
        log.on_gpu(example_gpu(index, index == 17 ? 40 : index == 30 || index == 9 ? 20 : 4));
    }
    log.finish();
    std::vector<std::uint64_t> numbers;
    for (const std::size_t row : log.worst(4)) {
        numbers.push_back(log.number(row));
    }
    EXPECT_THAT(numbers, ElementsAre(17, 9, 30, 5));
    EXPECT_TRUE(log.worst(0).empty());
    EXPECT_EQ(log.worst(1000).size(), 45U);
}

TEST(FrameLog, OfNothingIsEmpty) {
    FrameLog log({});
    log.finish();
    EXPECT_EQ(log.rows(), 0U);
    EXPECT_TRUE(log.worst(10).empty());
    EXPECT_EQ(log.column("nothing"), nullptr);
    for (const SessionRow& row : rows_of(log, std::array{50.0})) {
        EXPECT_EQ(row.known, 0U);
        EXPECT_EQ(row.mean, std::nullopt);
        EXPECT_EQ(row.percentiles[0], std::nullopt);
    }
}

std::string csv_of(const FrameLog& log) {
    std::string text;
    EXPECT_TRUE(write_frame_csv(log, [&text](std::string_view piece) -> Expected<void> {
        text += piece;
        return {};
    }));
    return text;
}

TEST(FrameCsv, LeavesUnknownCellsEmptyAndIsExact) {
    FrameLog log(example_config());
    frame::FrameRecord frame = example_frame(3);
    frame.fovea.eyes[0].sampled.ns -= 1;
    log.on_frame(frame);
    frame = example_frame(4);
    frame.should_render = false;
    log.on_frame(frame);
    frame = example_frame(6);
    frame.stamps = {};
    log.on_frame(frame);
    log.finish();
    std::istringstream lines(csv_of(log));
    std::string head;
    std::string first;
    std::string second;
    std::string third;
    std::getline(lines, head);
    std::getline(lines, first);
    std::getline(lines, second);
    std::getline(lines, third);
    EXPECT_TRUE(
        head.starts_with("frame,wake_up_ns,shown_ns,gaze_state,eye_event,"
                         "gaze_age_at_latch_ms,gaze_age_read_at_begin_ms,gaze_age_at_display_ms,"
                         "gaze_age_uncertainty_ms,stage_tracker_ms,"))
        << head;
    EXPECT_THAT(head, HasSubstr(",gaze_error_at_display_degrees,"));
    EXPECT_TRUE(
        first.starts_with("3,30000000,43000000,tracking,,5.000001,6.000001,18.000001,,3.000001,"))
        << first;
    EXPECT_TRUE(second.starts_with("4,40000000,,,,,,,,,")) << second;
    EXPECT_TRUE(third.starts_with("6,,,tracking,,,,,,3.000000,,")) << third;
    const auto commas = std::ranges::count(head, ',');
    EXPECT_EQ(std::ranges::count(first, ','), commas);
    EXPECT_EQ(std::ranges::count(third, ','), commas);
}

TEST(FrameCsv, WritesNegativeNumbersAndEndsWithAnError) {
    FrameLog log(example_config());
    frame::FrameRecord frame = example_frame(0);
    frame.stamps.end_frame.ns = frame.stamps.wake_up.ns - 1;
    log.on_frame(frame);
    log.finish();
    EXPECT_THAT(csv_of(log), HasSubstr(",-0.000001,"));
    EXPECT_EQ(log.at(kLoopTime.key).negative(), 1U);
    const auto written = write_frame_csv(log, [](std::string_view) -> Expected<void> {
        return std::unexpected(Error{ErrorKind::BadInput, "full"});
    });
    ASSERT_FALSE(written);
    EXPECT_EQ(written.error().message, "full");
}

}  // namespace
}  // namespace gazeloop::report
