#include "runtime/report/budget_gate.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>
#include <sstream>
#include <string>

#include "tests/unit/latency/example_frame.h"

namespace gazeloop::report {
namespace {

using latency::example_frame;
using latency::example_gpu;
using latency::kMs;
using latency::Stage;
using testing::HasSubstr;
using testing::Not;

/// Frames whose gaze is 16 ms old at the display, 4 ms of it on the GPU; the first ones do not know
/// when they were shown.
latency::SummaryReport report_of(std::uint64_t frames, std::uint64_t unknown = 0) {
    latency::LatencySummary summary({.period_ns = latency::kExamplePeriodNs});
    for (std::uint64_t index = 0; index < frames; ++index) {
        frame::FrameRecord frame = example_frame(index);
        if (index < unknown) {
            frame.stamps.display = {};
        }
        summary.add(frame);
        summary.add(example_gpu(index));
    }
    return summary.report();
}

latency::LatencyBudget budget_of(std::optional<std::int64_t> total_ms,
                                 std::optional<std::int64_t> gpu_ms = {}) {
    latency::LatencyBudget budget{.name = "test", .description = {}, .source = {}};
    if (total_ms) {
        budget.total_ns = *total_ms * kMs;
    }
    if (gpu_ms) {
        budget.stages_ns[static_cast<std::size_t>(Stage::Gpu)] = *gpu_ms * kMs;
    }
    return budget;
}

std::string refusal(const BudgetGate& gate) {
    const auto result = gate.result();
    if (result) {
        return "kept";
    }
    EXPECT_EQ(result.error().kind, ErrorKind::GateFailed);
    return result.error().message;
}

TEST(BudgetGate, PassesWhatIsWithin) {
    const BudgetGate gate = budget_gate(report_of(200), budget_of(17, 5));
    EXPECT_EQ(refusal(gate), "kept");
    ASSERT_EQ(gate.parts.size(), 2U);
    EXPECT_EQ(gate.parts[0].known, 200U);
    EXPECT_NEAR(gate.parts[0].p95_ms.value_or(0.0), 16.0, 0.04);
    EXPECT_THAT(gate_text(gate), HasSubstr("kept"));
    EXPECT_THAT(gate_text(gate), Not(HasSubstr("BROKEN")));
    EXPECT_EQ(gate_json(gate)["kept"], true);
}

TEST(BudgetGate, ShowsWhatKeepsEqualLookingFiguresApart) {
    const BudgetGate gate{.budget = "test",
                          .parts = {{.name = "gaze age at display",
                                     .key = "gaze_age_at_display",
                                     .allowed_ns = 37'550'000,
                                     .p95_ms = 37.550'04,
                                     .known = 100,
                                     .verdict = GateVerdict::Broken}},
                          .with_gaze = 100,
                          .pace = latency::Verdict::Unknown};
    EXPECT_THAT(refusal(gate), HasSubstr("p95 37.55004 ms, allowed 37.55000 ms"));
    EXPECT_THAT(gate_text(gate), HasSubstr("37.55004    37.55000"));
}

TEST(BudgetGate, NamesEachBrokenPart) {
    const BudgetGate total = budget_gate(report_of(200), budget_of(15, 5));
    EXPECT_THAT(refusal(total), HasSubstr("budget test broken: gaze age at display: p95 16.0"));
    EXPECT_THAT(refusal(total), HasSubstr("allowed 15.00 ms"));
    EXPECT_THAT(refusal(total), Not(HasSubstr("gpu")));
    const BudgetGate stage = budget_gate(report_of(200), budget_of(17, 3));
    EXPECT_THAT(refusal(stage), HasSubstr("broken: gpu: p95 4.0"));
    const BudgetGate both = budget_gate(report_of(200), budget_of(15, 3));
    EXPECT_THAT(refusal(both), HasSubstr("; gpu: p95 4.0"));
    EXPECT_EQ(gate_json(both)["parts"]["gpu"]["verdict"], "broken");
    EXPECT_EQ(gate_json(both)["kept"], false);
}

TEST(BudgetGate, RefusesToJudgeByTooFewFrames) {
    EXPECT_EQ(refusal(budget_gate(report_of(20), budget_of(17))), "kept");
    EXPECT_THAT(refusal(budget_gate(report_of(19), budget_of(17))),
                HasSubstr("not judgeable: gaze age at display: only 19 of 19 frames"));
    EXPECT_THAT(refusal(budget_gate(report_of(0), budget_of(17))),
                HasSubstr("only 0 of 0 frames with gaze know it"));
    EXPECT_THAT(refusal(budget_gate(report_of(19), budget_of(1))), HasSubstr("not judgeable"))
        << "nor are nineteen late frames a 95th percentile";
}

TEST(BudgetGate, NeverTakesUnknownForKept) {
    EXPECT_EQ(refusal(budget_gate(report_of(1000, 50), budget_of(17))), "kept");
    const BudgetGate gate = budget_gate(report_of(1000, 51), budget_of(17));
    EXPECT_THAT(refusal(gate), HasSubstr("not judgeable: gaze age at display: only 949 of 1000"));
    EXPECT_THAT(gate_text(gate), HasSubstr("not judgeable"));
    EXPECT_EQ(gate_json(gate)["parts"]["gaze_age_at_display"]["verdict"], "not-judgeable");
    // What is known to be above is broken, however much else is unknown.
    EXPECT_THAT(refusal(budget_gate(report_of(1000, 500), budget_of(15))), HasSubstr("broken"));
    const BudgetGate stage = budget_gate(report_of(1000, 1000), budget_of({}, 5));
    EXPECT_EQ(refusal(stage), "kept") << "the GPU's time is known all the same";
    EXPECT_EQ(gate_json(budget_gate(report_of(1000, 1000),
                                    budget_of(17)))["parts"]["gaze_age_at_display"]["p95_ms"],
              nullptr);
}

TEST(BudgetGate, IsAtMostAHundredColumnsWide) {
    latency::LatencyBudget budget = budget_of(17);
    budget.stages_ns.fill(1000 * kMs);
    std::istringstream text(gate_text(budget_gate(report_of(100), budget)));
    int lines = 0;
    for (std::string line; std::getline(text, line); ++lines) {
        EXPECT_LE(line.size(), 100U) << line;
    }
    EXPECT_GE(lines, 12);
}

}  // namespace
}  // namespace gazeloop::report
