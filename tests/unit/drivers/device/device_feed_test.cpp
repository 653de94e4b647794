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

}  // namespace
}  // namespace gazeloop::drivers
