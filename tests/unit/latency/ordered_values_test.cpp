#include "runtime/latency/ordered_values.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <deque>
#include <limits>
#include <random>
#include <vector>

#include "tests/support/allocation_counter.h"

namespace gazeloop::latency {
namespace {

TEST(OrderedValues, WithholdsWhatTooFewSupport) {
    OrderedValues values(100);
    EXPECT_EQ(values.percentile(50), std::nullopt);
    for (std::int64_t i = 1; i <= 99; ++i) {
        values.replace({}, i);
        EXPECT_EQ(values.percentile(50).has_value(), i >= 2) << i;
        EXPECT_EQ(values.percentile(95).has_value(), i >= 20) << i;
        EXPECT_FALSE(values.percentile(99).has_value()) << i;
    }
    values.replace({}, 100);
    EXPECT_EQ(values.percentile(50), 50);
    EXPECT_EQ(values.percentile(95), 95);
    EXPECT_EQ(values.percentile(99), 99);
}

TEST(OrderedValues, KeepEqualOnesAndExtremes) {
    constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();
    OrderedValues values(4);
    for (const std::int64_t value : {kMax, kMin, kMax, std::int64_t{0}}) {
        values.replace({}, value);
    }
    EXPECT_TRUE(
        std::ranges::equal(values.values(), std::vector<std::int64_t>{kMin, 0, kMax, kMax}));
    values.replace(kMax, kMin);
    EXPECT_TRUE(
        std::ranges::equal(values.values(), std::vector<std::int64_t>{kMin, kMin, 0, kMax}));
    values.replace(kMin, kMin);
    values.replace(0, {});
    EXPECT_TRUE(std::ranges::equal(values.values(), std::vector<std::int64_t>{kMin, kMin, kMax}));
    values.replace({}, {});
    EXPECT_EQ(values.size(), 3U);
}

TEST(OrderedValues, AreASortedWindowOfAnyStream) {
    std::mt19937_64 random(7);
    for (const std::int64_t distinct : {1, 3, 1000}) {
        OrderedValues values(64);
        std::deque<std::int64_t> window;
        for (int i = 0; i < 5000; ++i) {
            const bool full = window.size() == 64;
            std::optional<std::int64_t> gone;
            std::optional<std::int64_t> come;
            if (full || (!window.empty() && random() % 3 == 0)) {
                gone = window.front();
                window.pop_front();
            }
            if (full || random() % 4 != 0) {
                come = static_cast<std::int64_t>(random() % static_cast<std::uint64_t>(distinct));
                window.push_back(*come);
            }
            values.replace(gone, come);
            std::vector<std::int64_t> sorted(window.begin(), window.end());
            std::ranges::sort(sorted);
            ASSERT_TRUE(std::ranges::equal(values.values(), sorted)) << i;
        }
    }
}

TEST(OrderedValues, AllocateNothingLater) {
    OrderedValues values(10);
    const std::size_t before = tests::allocations_of_this_thread();
    for (std::int64_t i = 0; i < 100; ++i) {
        values.replace(i < 10 ? std::nullopt : std::optional(i - 10), i);
    }
    EXPECT_EQ(tests::allocations_of_this_thread(), before);
    EXPECT_EQ(values.size(), 10U);
}

}  // namespace
}  // namespace gazeloop::latency
