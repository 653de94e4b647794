#include "drivers/trace/clock/rows_read.h"

#include <gtest/gtest.h>

#include <array>

#include "tests/unit/drivers/trace/clock/trace_rows.h"

namespace gazeloop::drivers {
namespace {

/// The openness tells the rows of good_rows() apart.
double which(const gaze::GazeSample& sample) { return sample.eyes[0].openness; }

TEST(RowsRead, HoldsClocksBesideWhatBecomesSamples) {
    auto rows = good_rows(3);
    rows[1].parallax_rad = 0.5;
    rows[2].head = gaze::Pose{.position_m = {1.0, 2.0, 3.0}};
    RowsRead read{rows};
    ASSERT_EQ(read.size(), 3U);
    EXPECT_EQ(read[2].line, 4U);
    EXPECT_EQ(read[1].device_ticks, rows[1].device_ticks);
    EXPECT_EQ(read.eyes(1)[1].openness, rows[1].eyes[1].openness);
    constexpr std::array<std::size_t, 3> kAll{0, 1, 2};
    const std::vector<gaze::GazeSample> samples = read.take(kAll);
    ASSERT_EQ(samples.size(), 3U);
    EXPECT_EQ(samples[1].parallax_rad, 0.5);
    ASSERT_TRUE(samples[2].head.has_value());
    EXPECT_EQ(samples[2].head->position_m.z, 3.0);
    EXPECT_TRUE(read.empty());
}

TEST(RowsRead, TakesRowsInAnyOrderAndLeavesOthersOut) {
    const auto rows = good_rows(7);
    const std::vector<std::vector<std::size_t>> orders{{0, 1, 2, 3, 4, 5, 6},
                                                       {6, 5, 4, 3, 2, 1, 0},
                                                       {6, 0, 1, 2, 3, 4, 5},
                                                       {1, 2, 3, 4, 5, 6, 0},
                                                       {2, 0, 6},
                                                       {5},
                                                       {0, 2, 4, 6},
                                                       {3, 6, 1, 4},
                                                       {}};
    for (const std::vector<std::size_t>& order : orders) {
        RowsRead read{rows};
        const std::vector<gaze::GazeSample> samples = read.take(order);
        ASSERT_EQ(samples.size(), order.size());
        for (std::size_t i = 0; i < order.size(); ++i) {
            EXPECT_EQ(which(samples[i]), rows[order[i]].eyes[0].openness) << i;
        }
    }
}

}  // namespace
}  // namespace gazeloop::drivers
