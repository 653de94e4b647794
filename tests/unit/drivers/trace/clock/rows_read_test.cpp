#include "drivers/trace/clock/rows_read.h"

#include <gtest/gtest.h>

#include <utility>

#include "tests/unit/drivers/trace/clock/trace_rows.h"

namespace gazeloop::drivers {
namespace {

gaze::GazeSample sample_of(const KeptRow& row) {
    gaze::GazeSample sample;
    row.write_to(sample);
    return sample;
}

TEST(RowsRead, HoldsClocksBesideWhatBecomesSamples) {
    auto rows = good_rows(3);
    rows[1].parallax_rad = 0.5;
    rows[1].eyes[0].valid = false;
    rows[2].head = gaze::Pose{.position_m = {1.0, 2.0, 3.0}};
    RowsRead read{rows};
    ASSERT_EQ(read.size(), 3U);
    EXPECT_EQ(read[2].line, 4U);
    EXPECT_EQ(read[1].device_ticks, rows[1].device_ticks);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        const gaze::GazeSample sample = sample_of(read.kept(i));
        for (const gaze::Eye eye : gaze::kEyes) {
            const gaze::EyeRay& expected = rows[i].eyes[gaze::index(eye)];
            const gaze::EyeRay& ray = sample.eyes[gaze::index(eye)];
            EXPECT_EQ(read.kept(i).valid(eye), expected.valid);
            EXPECT_EQ(ray.valid, expected.valid);
            EXPECT_EQ(ray.direction, expected.direction);
            EXPECT_EQ(ray.origin_m, expected.origin_m);
            EXPECT_EQ(ray.openness, expected.openness);
            EXPECT_EQ(ray.confidence, expected.confidence);
        }
        EXPECT_EQ(sample.parallax_rad, rows[i].parallax_rad);
        EXPECT_EQ(sample.head.has_value(), rows[i].head.has_value());
    }
    EXPECT_EQ(sample_of(read.kept(2)).head->position_m.z, 3.0);
}

/// As rows that are compared with each other are asked for.
TEST(RowsRead, GivesTwoRowsAtOnceHoweverFarApart) {
    const auto rows = good_rows(20'000);
    RowsRead moved{rows};
    const RowsRead read = std::move(moved);
    const auto openness = [&](const KeptRow& row) { return sample_of(row).eyes[0].openness; };
    for (std::size_t i = 0; i < rows.size(); i += 97) {
        const std::size_t k = (i * 7919) % rows.size();
        const KeptRow& one = read.kept(i);
        const KeptRow& other = read.kept(k);
        ASSERT_EQ(openness(one), rows[i].eyes[0].openness) << i;
        ASSERT_EQ(openness(other), rows[k].eyes[0].openness) << k;
        EXPECT_EQ(one.same_ray(other, gaze::Eye::Left),
                  rows[i].eyes[0].openness == rows[k].eyes[0].openness);
    }
}

}  // namespace
}  // namespace gazeloop::drivers
