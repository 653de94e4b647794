#include "runtime/latency/gaze_use.h"

#include <gtest/gtest.h>

#include <limits>
#include <utility>
#include <vector>

#include "tests/unit/latency/example_frame.h"

namespace gazeloop::latency {
namespace {

frame::FrameRecord with_sample(std::uint64_t index, std::uint64_t sequence) {
    frame::FrameRecord frame = example_frame(index);
    for (gaze::FoveaPoint& eye : frame.fovea.eyes) {
        eye.sample_sequence = sequence;
    }
    return frame;
}

frame::FrameRecord without_gaze(std::uint64_t index, gaze::FoveaState state,
                                gaze::LossReason reason) {
    frame::FrameRecord frame = example_frame(index);
    frame.fovea.eyes[1].state = state;
    frame.fovea.eyes[1].reason = reason;
    return frame;
}

GazeUseCounts counts_of(const std::vector<frame::FrameRecord>& frames) {
    GazeUse use;
    for (const frame::FrameRecord& frame : frames) {
        use.add(frame);
    }
    return use.counts();
}

TEST(GazeUse, KnowsNothingOfNoFrames) {
    const GazeUseCounts counts = counts_of({});
    EXPECT_FALSE(counts.reused_percent());
    EXPECT_FALSE(counts.lost_percent());
    EXPECT_FALSE(counts_of({with_sample(0, 1)}).reused_percent());
}

TEST(GazeUse, CountsFramesThatShowTheSampleOfTheFrameBefore) {
    const GazeUseCounts counts =
        counts_of({with_sample(0, 7), with_sample(1, 7), with_sample(2, 8), with_sample(3, 8),
                   with_sample(4, 8), with_sample(5, 9), with_sample(6, 10)});
    EXPECT_EQ(counts.reused, 3U);
    EXPECT_EQ(counts.comparable, 6U);
    EXPECT_DOUBLE_EQ(counts.reused_percent().value_or(0.0), 50.0);
    EXPECT_EQ(counts.longest_reuse.frames, 3U);
    EXPECT_EQ(counts.longest_reuse.first, 2U);
    EXPECT_EQ(counts.longest_reuse.lasted, (time::Span{30 * kMs, time::StampKind::Measured}));
    EXPECT_EQ(counts.lost, 0U);
}

TEST(GazeUse, ComparesNeighboursOnly) {
    frame::FrameRecord hidden = with_sample(1, 7);
    hidden.should_render = false;
    // Frame 3 is missing, and frame 1 was not rendered.
    const GazeUseCounts counts =
        counts_of({with_sample(0, 7), hidden, with_sample(2, 7), with_sample(4, 7)});
    EXPECT_EQ(counts.rendered, 3U);
    EXPECT_EQ(counts.comparable, 0U);
    EXPECT_EQ(counts.reused, 0U);
    EXPECT_EQ(counts.longest_reuse.frames, 0U);
}

TEST(GazeUse, CountsLossesByReasonWithTheLongest) {
    using gaze::FoveaState;
    using gaze::LossReason;
    const GazeUseCounts counts =
        counts_of({without_gaze(0, FoveaState::Ahead, LossReason::Never), with_sample(1, 1),
                   without_gaze(2, FoveaState::Held, LossReason::Invalid), with_sample(3, 2),
                   without_gaze(4, FoveaState::Held, LossReason::Stale),
                   without_gaze(5, FoveaState::Returning, LossReason::Stale),
                   without_gaze(6, FoveaState::Ahead, LossReason::Stale), with_sample(7, 3)});
    EXPECT_EQ(counts.rendered, 8U);
    EXPECT_EQ(counts.lost, 5U);
    EXPECT_EQ(counts.before_first, 1U);
    EXPECT_EQ(counts.lost_by_reason[static_cast<std::size_t>(LossReason::Never)], 1U);
    EXPECT_EQ(counts.lost_by_reason[static_cast<std::size_t>(LossReason::Invalid)], 1U);
    EXPECT_EQ(counts.lost_by_reason[static_cast<std::size_t>(LossReason::Stale)], 3U);
    EXPECT_EQ(counts.longest_loss.frames, 3U);
    EXPECT_EQ(counts.longest_loss.first, 4U);
    EXPECT_EQ(counts.longest_loss.lasted, (time::Span{30 * kMs, time::StampKind::Measured}));
    EXPECT_EQ(counts.comparable, 0U);  // none of the frames with gaze follow on each other
}

TEST(GazeUse, KnowsNoLengthWhereNoTimeIsKnown) {
    frame::FrameRecord lost = without_gaze(1, gaze::FoveaState::Held, gaze::LossReason::Invalid);
    lost.stamps.wake_up = {};
    const GazeUseCounts counts = counts_of({with_sample(0, 1), lost, with_sample(2, 2)});
    EXPECT_EQ(counts.longest_loss.frames, 1U);
    EXPECT_FALSE(counts.longest_loss.lasted.known());
}

TEST(ExpectedReuse, IsWhatTheRatesLeaveNoChoiceIn) {
    EXPECT_DOUBLE_EQ(expected_reuse_percent(90.0, 120.0).value_or(-1.0), 25.0);
    EXPECT_DOUBLE_EQ(expected_reuse_percent(120.0, 90.0).value_or(-1.0), 0.0);
    EXPECT_FALSE(expected_reuse_percent(0.0, 90.0));
    EXPECT_FALSE(expected_reuse_percent(90.0, 0.0));
    EXPECT_FALSE(expected_reuse_percent(std::numeric_limits<double>::quiet_NaN(), 90.0));
}

}  // namespace
}  // namespace gazeloop::latency
