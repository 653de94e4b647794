#include "runtime/report/monitor_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <nlohmann/json.hpp>
#include <string>

#include "runtime/latency/budget_monitor.h"
#include "runtime/report/budget_account.h"
#include "runtime/report/monitor_json.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::report {
namespace {

using latency::example_frame;
using latency::example_gpu;
using latency::kMs;
using testing::HasSubstr;
using testing::Not;

latency::LatencyBudget example_budget() {
    latency::LatencyBudget budget{
        .name = "test", .description = {}, .source = "a test", .total_ns = 17 * kMs};
    budget.stages_ns[static_cast<std::size_t>(latency::Stage::Gpu)] = 3 * kMs;
    return budget;
}

/// 16 ms old at the display, 4 ms of it on the GPU, where the budget allows 3.
latency::MonitorSnapshot example_snapshot(std::uint64_t frames) {
    latency::BudgetMonitor monitor(example_budget(), 5'000'000'000);
    for (std::uint64_t index = 0; index < frames; ++index) {
        monitor.add(latency::account_of({example_frame(index), example_gpu(index)}, 0, {}), index,
                    latency::kExamplePeriodNs, [](const latency::BudgetEvent&) {});
    }
    return monitor.snapshot();
}

std::string text_of(const std::vector<PanelLine>& lines) {
    std::string text;
    for (const PanelLine& line : lines) {
        text += line.text + "\n";
    }
    return text;
}

std::string row(const std::string& text, const std::string& label) {
    const std::size_t begin = text.find("\n" + label);
    return begin == std::string::npos
               ? ""
               : text.substr(begin + 1, text.find('\n', begin + 1) - begin - 1);
}

TEST(MonitorPanel, ShowsEachPartAgainstItsBudget) {
    const std::string text = text_of(
        monitor_panel(example_snapshot(200), {.columns = 100, .rows = 40, .budget = "test"}));
    EXPECT_THAT(text, HasSubstr("budget test, last 2.0 s, 200 frames"));
    EXPECT_THAT(text, HasSubstr("gaze tracking: tracking 100 %"));
    const std::string gpu = row(text, " gpu");
    EXPECT_THAT(gpu, HasSubstr("4.00   4.00   4.00    3.00   200  200 fr, 2.0 s"));
    EXPECT_THAT(gpu, HasSubstr("####|"));
    const std::string age = row(text, "gaze age at display");
    EXPECT_THAT(age, HasSubstr("16.00  16.00  16.00   17.00     0"));
    EXPECT_EQ(row(text, " filter"), "") << "nobody stamped it";
    EXPECT_THAT(row(text, " switching"), HasSubstr("-")) << "unknown is never 0";
    EXPECT_THAT(row(text, " switching"), Not(HasSubstr("0.00")));
}

TEST(MonitorPanel, FitsAnyTerminal) {
    latency::MonitorSnapshot extreme = example_snapshot(200);
    for (latency::MonitorPart& part : extreme.parts) {
        part.limit_ns = part.p99_ns = std::numeric_limits<std::int64_t>::max();
        part.p50_ns = std::numeric_limits<std::int64_t>::min();
        part.violations = part.longest_run_frames = std::numeric_limits<std::uint64_t>::max();
        part.longest_run_ns = std::numeric_limits<std::int64_t>::max();
    }
    for (const latency::MonitorSnapshot& snapshot :
         {latency::MonitorSnapshot{}, example_snapshot(1), example_snapshot(200), extreme}) {
        for (const int columns : {-1, 0, 1, 2, 5, 19, 20, 28, 40, 60, 75, 76, 77, 80, 132, 1000}) {
            for (const int rows : {0, 1, 2, 3, 10, 24, 100}) {
                for (const bool colour : {false, true}) {
                    const auto lines = monitor_panel(
                        snapshot,
                        {.columns = columns, .rows = rows, .colour = colour, .budget = "test"});
                    EXPECT_LT(lines.size(), static_cast<std::size_t>(std::max(rows, 2)));
                    for (const PanelLine& line : lines) {
                        EXPECT_LT(line.columns, std::max(columns, 2));
                        if (!colour) {
                            EXPECT_EQ(line.text.size(), static_cast<std::size_t>(line.columns));
                        }
                    }
                }
            }
        }
    }
}

TEST(MonitorPanel, ColoursOnlyWhereItMay) {
    const latency::MonitorSnapshot snapshot = example_snapshot(200);
    EXPECT_THAT(text_of(monitor_panel(snapshot, {.columns = 80, .rows = 40, .budget = "test"})),
                Not(HasSubstr("\x1b")));
    const std::string coloured = text_of(
        monitor_panel(snapshot, {.columns = 80, .rows = 40, .colour = true, .budget = "test"}));
    EXPECT_THAT(coloured, HasSubstr("\x1b[31m gpu"));
    EXPECT_THAT(coloured, HasSubstr("\x1b[32mgaze age at display"));
}

TEST(MonitorPanel, LetsNoNameMoveTheCursor) {
    const std::string text =
        text_of(monitor_panel(example_snapshot(1), {.columns = 80, .budget = "a\x1b[2Jb\n"}));
    EXPECT_THAT(text, Not(HasSubstr("\x1b")));
    EXPECT_THAT(text, HasSubstr("budget a?[2Jb?,"));
}

TEST(MonitorLine, SaysTheSameInWords) {
    const std::string line = monitor_line(example_snapshot(200), "test");
    EXPECT_THAT(line,
                HasSubstr("p50 16.00, p95 16.00, p99 16.00 ms in 200 of 200 frames of 2.0 s"));
    EXPECT_THAT(line, HasSubstr("budget test: BROKEN: gpu 4.00 above 3.00 ms"));
    EXPECT_THAT(line, HasSubstr("frames above: gpu 200"));
    EXPECT_THAT(monitor_line(example_snapshot(3), "test"), HasSubstr("not judged yet"));
    EXPECT_THAT(monitor_line({}, ""), HasSubstr("gaze none yet"));
    EXPECT_THAT(monitor_line({}, ""), Not(HasSubstr("budget")));
}

TEST(MonitorJson, SaysTheSameForPrograms) {
    const auto begin = nlohmann::json::parse(monitor_begin_json(example_budget(), "wall"));
    EXPECT_EQ(begin["what"], "begin");
    EXPECT_EQ(begin["schema"], 1);
    EXPECT_EQ(begin["budget"]["total_ms"], 17.0);
    EXPECT_EQ(begin["budget"]["stages_ms"], (nlohmann::json{{"gpu", 3.0}}));
    EXPECT_EQ(nlohmann::json::parse(monitor_begin_json({}, "wall"))["budget"], nullptr);

    const std::string text = monitor_snapshot_json("interval", example_snapshot(200), 7);
    EXPECT_EQ(text.find('\n'), std::string::npos);
    const auto line = nlohmann::json::parse(text);
    EXPECT_EQ(line["what"], "interval");
    EXPECT_EQ(line["frame"], 199);
    EXPECT_EQ(line["lines_dropped"], 7);
    EXPECT_EQ(line["parts"].size(), latency::kMonitorPartCount);
    const auto& gpu = line["parts"]["gpu"];
    EXPECT_EQ(gpu["limit_ms"], 3.0);
    EXPECT_EQ(gpu["broken"], true);
    EXPECT_EQ(gpu["p95_ms"], 4.0);
    EXPECT_EQ(gpu["run"]["above"], 200);
    EXPECT_EQ(gpu["run"]["longest_ms"], 2000.0);
    EXPECT_EQ(line["parts"]["filter"]["p50_ms"], nullptr);
    EXPECT_EQ(line["parts"]["filter"]["broken"], nullptr);
    EXPECT_EQ(line["window"]["by_gaze_state"]["tracking"], 200);

    const auto nothing = nlohmann::json::parse(monitor_snapshot_json("end", {}, 0));
    EXPECT_EQ(nothing["time_ns"], nullptr);
    EXPECT_EQ(nothing["frame"], nullptr);
    EXPECT_EQ(nothing["gaze_state"], nullptr);
    EXPECT_EQ(nothing["window"]["percent_by_kind"], nullptr);

    const auto event = nlohmann::json::parse(
        monitor_event_json({5, time::StampKind::Measured}, "budget-broken", "bad \xff text", 0));
    EXPECT_EQ(event["kind"], "budget-broken");
    EXPECT_EQ(event["warning"], true);
    EXPECT_EQ(event["time_ns"], 5);
}

TEST(BudgetAccount, SaysWhatARunMadeOfIt) {
    const std::string text = budget_account_text(example_snapshot(200), example_budget());
    EXPECT_THAT(text, HasSubstr("budget test\n"));
    EXPECT_THAT(text, HasSubstr("200 frames, 2000.0 ms"));
    const auto json = budget_account_json(example_snapshot(200), example_budget());
    EXPECT_EQ(json["parts"].size(), 2U);
    EXPECT_EQ(json["parts"]["gpu"]["above"], 200);
    EXPECT_EQ(json["parts"]["gaze_age_at_display"]["above"], 0);
    // No frame knew it: that is not none above.
    EXPECT_EQ(budget_account_json(example_snapshot(0), example_budget())["parts"]["gpu"]["above"],
              nullptr);
}

}  // namespace
}  // namespace gazeloop::report
