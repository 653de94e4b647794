#include "runtime/preview/stage_bars.h"

#include <gtest/gtest.h>

#include <string>

#include "runtime/latency/gaze_age.h"
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

TEST(StageBars, AddUpToTheTotal) {
    const StageBars bars =
        stage_bars(latency::example_frame(7), latency::example_gpu(7), 2'000'000);
    EXPECT_TRUE(bars.any);
    EXPECT_EQ(bars.frame, 7U);
    const StageBar& photon = bars.bars[0];
    EXPECT_EQ(std::string(photon.title.data()), "eye to photon");
    ASSERT_EQ(photon.count, latency::kStageCount);
    ASSERT_TRUE(photon.total_known);
    EXPECT_NEAR(sum_ms(photon), photon.total_ms, 1e-9);
    EXPECT_GE(bar_scale_ms(bars), photon.total_ms);
    EXPECT_GE(bar_scale_ms(bars), bars.budget_ms);
}

TEST(StageBars, ShowOnlyThePassesThatRan) {
    latency::FrameGpuRecord gpu = latency::example_gpu(1);
    gpu.pass_ns.fill(-1);
    gpu.pass_ns[1] = 4'000'000;
    const StageBars bars = stage_bars(latency::example_frame(1), gpu, std::nullopt);
    ASSERT_EQ(bars.bars[1].count, 1U);
    EXPECT_EQ(bars.bars[1].segments[0].name.data(), std::string(latency::kPassNames[1]));
    EXPECT_DOUBLE_EQ(bars.bars[1].segments[0].ms, 4.0);
}

TEST(StageBars, NeverShowTheUnknownAsZero) {
    latency::FrameRecord frame;  // every stamp unknown
    const StageBars bars = stage_bars(frame, latency::FrameGpuRecord{}, std::nullopt);
    EXPECT_FALSE(bars.bars[0].total_known);
    EXPECT_FALSE(bars.bars[1].total_known);
    for (std::uint32_t i = 0; i < bars.bars[0].count; ++i) {
        EXPECT_FALSE(bars.bars[0].segments[i].known) << i;
    }
    EXPECT_GE(bar_scale_ms(bars), 1.0);
}

}  // namespace
}  // namespace gazeloop::preview
