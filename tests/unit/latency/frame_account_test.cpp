#include "runtime/latency/frame_account.h"

#include <gtest/gtest.h>

#include <vector>

#include "tests/unit/latency/example_frame.h"

namespace gazeloop::latency {
namespace {

std::vector<std::uint64_t> indices_of(const std::vector<FinishedFrame>& frames) {
    std::vector<std::uint64_t> indices;
    for (const FinishedFrame& finished : frames) {
        indices.push_back(finished.frame.index);
    }
    return indices;
}

TEST(PendingFrames, JoinsAFrameWithItsGpuPart) {
    PendingFrames pending;
    std::vector<FinishedFrame> finished;
    const auto take = [&finished](const FinishedFrame& frame) { finished.push_back(frame); };
    pending.add(example_frame(7), take);
    pending.add(example_frame(8), take);
    pending.add(example_gpu(9), take);  // of no frame that is pending
    EXPECT_TRUE(finished.empty());
    pending.add(example_gpu(8), take);
    pending.add(example_gpu(7), take);
    EXPECT_EQ(indices_of(finished), (std::vector<std::uint64_t>{8, 7}));
    EXPECT_EQ(finished[0].gpu->gpu_end, example_gpu(8).gpu_end);
    pending.add(example_gpu(7), take);
    pending.finish(take);
    EXPECT_EQ(finished.size(), 2U) << "each once";
}

TEST(PendingFrames, GivesUpOnAGpuPartAfterSixteenFrames) {
    PendingFrames pending;
    std::vector<FinishedFrame> finished;
    const auto take = [&finished](const FinishedFrame& frame) { finished.push_back(frame); };
    constexpr std::uint64_t kFirst = 13;
    for (std::uint64_t index = kFirst; index < kFirst + 2 * PendingFrames::kMost; ++index) {
        pending.add(example_frame(index), take);
    }
    EXPECT_EQ(finished.size(), PendingFrames::kMost);
    pending.finish(take);
    ASSERT_EQ(finished.size(), 2 * PendingFrames::kMost);
    for (std::size_t at = 0; at < finished.size(); ++at) {
        EXPECT_EQ(finished[at].frame.index, kFirst + at);
        EXPECT_FALSE(finished[at].gpu);
    }
}

TEST(FrameAccount, TakesTheGpusStampsUnlessTheFrameIsOfVirtualTime) {
    FinishedFrame finished{.frame = example_frame(3), .gpu = example_gpu(3)};
    EXPECT_EQ(account_of(finished, 0, {}).stamps.gpu_end, example_gpu(3).gpu_end);
    finished.frame.stamps.gpu_end = {1, time::StampKind::Modelled};
    EXPECT_EQ(account_of(finished, 0, {}).stamps.gpu_end, finished.frame.stamps.gpu_end);
    finished.gpu.reset();
    finished.frame.stamps.gpu_end = {};
    EXPECT_FALSE(account_of(finished, 0, {}).stamps.gpu_end.known());
}

TEST(FrameAccount, IsOfTheWorseEyeAndHasNoAgeWithoutGaze) {
    FinishedFrame finished{.frame = example_frame(3), .gpu = example_gpu(3)};
    finished.frame.fovea.eyes[1].state = gaze::FoveaState::OtherEye;
    FrameAccount account = account_of(finished, 0, {.switching_ns = 2 * kMs});
    EXPECT_EQ(account.state, gaze::FoveaState::OtherEye);
    EXPECT_TRUE(account.with_gaze());
    EXPECT_EQ(account.age.at_display.ns, 18 * kMs);
    finished.frame.fovea.eyes[0].state = gaze::FoveaState::Ahead;
    account = account_of(finished, 0, {.switching_ns = 2 * kMs});
    EXPECT_FALSE(account.with_gaze());
    EXPECT_FALSE(account.age.at_display.known());
    EXPECT_FALSE(account.age.at_latch.known());
}

TEST(FrameAccount, UsesTheGivenPeriodWhereTheFrameWasAnnouncedNone) {
    FinishedFrame finished{.frame = example_frame(3), .gpu = example_gpu(3, 15)};
    finished.frame.period_ns = 0;
    EXPECT_FALSE(account_of(finished, 0, {}).shown.at.known());
    EXPECT_EQ(account_of(finished, kExamplePeriodNs, {}).shown.at.ns,
              finished.frame.stamps.display.ns + kExamplePeriodNs);
}

}  // namespace
}  // namespace gazeloop::latency
