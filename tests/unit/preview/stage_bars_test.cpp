#include "runtime/preview/stage_bars.h"

#include <gtest/gtest.h>

#include <string>

#include "runtime/latency/gaze_age.h"
#include "runtime/latency/latency_summary.h"
#include "runtime/report/summary_rows.h"
#include "tests/unit/latency/example_frame.h"

namespace gazeloop::preview {
namespace {

double sum_ms(const StageBar& bar) {
    double sum = 0.0;
    for (std::uint32_t i = 0; i < bar.count; ++i) {
        sum += bar.segments[i].ms;
    }
    return sum;
}

const DisplayTimes kDisplay{
    .period_ns = 10'000'000, .switching_ns = 2'000'000, .rolling_ns = 8'000'000};

// The window and the summary say the same of the same frame.
TEST(StageBars, AreWhatTheSummarySays) {
    frame::FrameRecord frame = latency::example_frame(0);
    for (std::size_t eye = 0; eye < gaze::kEyeCount; ++eye) {
        frame.views[eye].height_px = 1440;
        frame.fovea.eyes[eye].position.y_px = 1300.0;
    }
    for (const std::int64_t period_ns : {10'000'000, 20'000'000, 11'000'000}) {
        frame.period_ns = period_ns;
        latency::LatencySummary summary({.period_ns = kDisplay.period_ns,
                                         .switching_ns = kDisplay.switching_ns,
                                         .rolling_ns = kDisplay.rolling_ns});
        summary.add_display_period(period_ns);
        summary.add(frame);
        const frame::FrameGpuRecord gpu = latency::example_gpu(0);
        summary.add(gpu);
        const latency::SummaryReport report = summary.report();
        const StageBar photon = stage_bars(frame, gpu, latency::kExamplePasses, kDisplay).bars[0];
        EXPECT_NEAR(photon.total_ms, report.gaze_age_at_display.mean_ms.value(), 1e-9);
        std::size_t bar = 0;
        for (const report::NamedRow& row : report::rows_of(report)) {
            if (row.name.key.starts_with("stage_")) {
                ASSERT_LT(bar, photon.count);
                const auto& segment = photon.segments[bar++];
                EXPECT_EQ(row.name.label, "  " + std::string(segment.name.data()));
                EXPECT_EQ(segment.known, row.row->count == 1) << row.name.label;
                EXPECT_NEAR(segment.ms, row.row->mean_ms.value_or(0.0), 1e-9) << row.name.label;
            }
        }
        EXPECT_EQ(bar, photon.count);
        const bool is_the_profiles = period_ns != 11'000'000;
        EXPECT_EQ(report.stages[static_cast<std::size_t>(latency::Stage::Row)].count == 1,
                  is_the_profiles);
    }
}

TEST(StageBars, AddUpToTheTotal) {
    const StageBars bars = stage_bars(latency::example_frame(7), latency::example_gpu(7),
                                      latency::kExamplePasses, kDisplay);
    EXPECT_TRUE(bars.any);
    EXPECT_EQ(bars.frame, 7U);
    const StageBar& photon = bars.bars[0];
    EXPECT_EQ(std::string(photon.title.data()), "eye to photon");
    ASSERT_EQ(photon.count, latency::kStageCount - 4)
        << "delivery, filter, compositor and row are not known";
    ASSERT_TRUE(photon.total_known);
    EXPECT_NEAR(sum_ms(photon), photon.total_ms, 1e-9);
    EXPECT_GE(bar_scale_ms(bars), photon.total_ms);
    EXPECT_GE(bar_scale_ms(bars), bars.budget_ms);
}

TEST(StageBars, ShowOnlyThePassesThatRan) {
    frame::FrameGpuRecord gpu = latency::example_gpu(1);
    gpu.passes = {};
    gpu.passes.set(1, 4'000'000);
    const StageBars bars = stage_bars(latency::example_frame(1), gpu, latency::kExamplePasses, {});
    ASSERT_EQ(bars.bars[1].count, 1U);
    EXPECT_EQ(bars.bars[1].segments[0].name.data(), latency::kExamplePasses[1]);
    EXPECT_DOUBLE_EQ(bars.bars[1].segments[0].ms, 4.0);
}

TEST(StageBars, ShowAsManyPassesAsARunCanHave) {
    std::string names;
    frame::FrameGpuRecord gpu;
    for (std::size_t pass = 0; pass < frame::kMostPasses; ++pass) {
        names += (pass == 0 ? "pass" : " pass") + std::to_string(pass);
        gpu.passes.set(pass, static_cast<std::int64_t>(pass + 1) * 1'000'000);
    }
    const auto passes = frame::PassList::parse(names, frame::kMostPasses);
    ASSERT_TRUE(passes.has_value());
    const StageBars bars = stage_bars(latency::example_frame(1), gpu, *passes, {});
    ASSERT_EQ(bars.bars[1].count, frame::kMostPasses);
    EXPECT_DOUBLE_EQ(sum_ms(bars.bars[1]), 78.0);
}

TEST(StageBars, NeverShowTheUnknownAsZero) {
    frame::FrameRecord frame;  // every stamp unknown
    const StageBars bars = stage_bars(frame, frame::FrameGpuRecord{}, latency::kExamplePasses, {});
    EXPECT_FALSE(bars.bars[0].total_known);
    EXPECT_FALSE(bars.bars[1].total_known);
    for (std::uint32_t i = 0; i < bars.bars[0].count; ++i) {
        EXPECT_FALSE(bars.bars[0].segments[i].known) << i;
    }
    EXPECT_GE(bar_scale_ms(bars), 1.0);
}

}  // namespace
}  // namespace gazeloop::preview
