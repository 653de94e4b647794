#include "drivers/device/device_feed.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <vector>

namespace gazeloop::drivers {
namespace {

// What the loop does not fetch in time is lost, and counted.
TEST(DeviceFeed, CountsWhatAFullQueueRefuses) {
    DeviceFeed feed;
    gaze::GazeSample sample;
    constexpr std::uint64_t kPushed = 5000;
    for (std::uint64_t i = 0; i < kPushed; ++i) {
        feed.push(sample);
    }
    std::vector<gaze::GazeSample> kept;
    feed.poll(kept);
    EXPECT_EQ(kept.size() + feed.dropped(), kPushed);
    EXPECT_GT(feed.dropped(), 0U);
    EXPECT_EQ(kept.back().sequence, kept.size()) << "the oldest are kept";
    feed.push(sample);
    kept.clear();
    feed.poll(kept);
    ASSERT_EQ(kept.size(), 1U);
    EXPECT_EQ(kept[0].sequence, kPushed + 1) << "the gap shows in the numbers";
}

// A driver tells it with the failure, and who reads the driver once more when the device has gone.
TEST(DeviceFeed, LosesOnceWhatItHad) {
    DeviceFeed feed;
    std::vector<gaze::GazeSample> kept;
    const auto lose = [&](std::int64_t at_ns) {
        kept.clear();
        feed.push_loss({at_ns, time::StampKind::Measured});
        feed.poll(kept);
        return kept.size();
    };
    EXPECT_EQ(lose(1), 0U) << "nothing had come";
    EXPECT_EQ(feed.last_sequence(), 0U);
    gaze::GazeSample sample;
    sample.device_ns = 77;
    sample.eyes[0].valid = true;
    for (std::int64_t round = 1; round < 4; ++round) {
        feed.push(sample);
        EXPECT_EQ(lose(10 * round), 2U);
        EXPECT_FALSE(kept[1].eyes[0].valid || kept[1].eyes[1].valid);
        EXPECT_TRUE(kept[1].tracker_gone);
        EXPECT_FALSE(kept[0].tracker_gone);
        EXPECT_EQ(kept[1].arrived.ns, 10 * round);
        EXPECT_EQ(kept[1].device_ns, 77);
        EXPECT_EQ(kept[1].sequence, kept[0].sequence + 1);
        EXPECT_EQ(lose(10 * round + 1), 0U) << "it is lost already";
    }
}

// One that the full queue refused is told again.
TEST(DeviceFeed, LosesAgainWhatNobodyHeardOf) {
    DeviceFeed feed;
    gaze::GazeSample sample;
    while (feed.dropped() == 0) {
        feed.push(sample);
    }
    const time::Stamp now{5, time::StampKind::Measured};
    feed.push_loss(now);
    std::vector<gaze::GazeSample> kept;
    feed.poll(kept);
    EXPECT_FALSE(kept.back().arrived.known());
    kept.clear();
    feed.push_loss(now);
    feed.poll(kept);
    ASSERT_EQ(kept.size(), 1U);
    EXPECT_EQ(kept[0].arrived, now);
}

}  // namespace
}  // namespace gazeloop::drivers
