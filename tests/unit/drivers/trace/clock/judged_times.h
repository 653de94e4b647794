#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "drivers/trace/clock/device_times.h"

namespace gazeloop::drivers {

/// Of good_rows().
inline constexpr std::int64_t kInterval = 8'333'333;

inline bool increases(std::span<const std::int64_t> times) {
    return std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
}

/// The times of good_rows() without row `dropped`.
inline void expect_good_but(const DeviceTimes& times, std::size_t count,
                            const std::vector<std::size_t>& dropped) {
    memory::LongVector<std::size_t> rows;
    for (std::size_t i = 0; i < count; ++i) {
        if (std::find(dropped.begin(), dropped.end(), i) == dropped.end()) {
            rows.push_back(i);
        }
    }
    ASSERT_EQ(times.rows, rows);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ASSERT_EQ(times.time_ns[i], static_cast<std::int64_t>(rows[i] - rows[0]) * kInterval) << i;
    }
}

/// One finding of that kind and no other: its line and how many rows it drops.
inline void expect_one(const DeviceTimes& times, gaze::TraceFindingKind kind, std::uint64_t line,
                       std::uint64_t dropped) {
    ASSERT_THAT(times.findings, ::testing::SizeIs(1));
    EXPECT_EQ(times.findings[0].kind, kind);
    EXPECT_EQ(times.findings[0].line, line);
    EXPECT_EQ(times.findings[0].dropped, dropped);
    EXPECT_FALSE(times.findings[0].text.empty());
}

}  // namespace gazeloop::drivers
