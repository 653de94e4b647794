#include "runtime/latency/duration_histogram.h"

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>

namespace gazeloop::latency {
namespace {

constexpr std::int64_t kMin = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kMax = std::numeric_limits<std::int64_t>::max();

TEST(DurationHistogram, KnowsNothingWhenEmpty) {
    const DurationHistogram histogram;
    EXPECT_EQ(histogram.count(), 0U);
    EXPECT_EQ(histogram.min_ms(), std::nullopt);
    EXPECT_EQ(histogram.max_ms(), std::nullopt);
    EXPECT_EQ(histogram.mean_ms(), std::nullopt);
    EXPECT_EQ(histogram.percentile_ms(50.0), std::nullopt);
}

TEST(DurationHistogram, OneSampleHasExtremesAndMeanButNoPercentile) {
    DurationHistogram histogram;
    histogram.add(-3'000'000);
    EXPECT_EQ(histogram.min_ms(), -3.0);
    EXPECT_EQ(histogram.max_ms(), -3.0);
    EXPECT_EQ(histogram.mean_ms(), -3.0);
    EXPECT_EQ(histogram.percentile_ms(50.0), std::nullopt);
}

TEST(DurationHistogram, WithholdsPercentilesUntilThereAreEnoughSamples) {
    struct Case {
        double percent;
        int needed;
    };
    for (const auto& [percent, needed] : {Case{50.0, 2}, Case{90.0, 10}, Case{95.0, 20},
                                          Case{99.0, 100}, Case{99.9, 1000}, Case{99.99, 10'000}}) {
        DurationHistogram histogram;
        for (int i = 0; i < needed - 1; ++i) {
            histogram.add(i);
        }
        EXPECT_EQ(histogram.percentile_ms(percent), std::nullopt) << percent;
        histogram.add(needed);
        EXPECT_NE(histogram.percentile_ms(percent), std::nullopt) << percent;
    }
}

TEST(DurationHistogram, PercentilesAreTheNearestRank) {
    DurationHistogram histogram;
    for (int i = 1; i <= 1000; ++i) {
        histogram.add(i % 500);  // every value from 0 to 499 twice, each in a bin of its own
    }
    EXPECT_EQ(histogram.percentile_ms(50.0), 249e-6);
    EXPECT_EQ(histogram.percentile_ms(99.0), 494e-6);
    EXPECT_EQ(histogram.percentile_ms(99.9), 499e-6);
    EXPECT_EQ(histogram.percentile_ms(0.1), 0.0);
}

TEST(DurationHistogram, RefusesPercentsOutsideItsRange) {
    DurationHistogram histogram;
    histogram.add(1);
    histogram.add(2);
    for (const double percent :
         {0.0, 100.0, -1.0, 101.0, std::numeric_limits<double>::quiet_NaN()}) {
        EXPECT_EQ(histogram.percentile_ms(percent), std::nullopt) << percent;
    }
}

TEST(DurationHistogram, TakesTheExtremesOfItsType) {
    DurationHistogram histogram;
    for (const std::int64_t value : {kMin, kMin, std::int64_t{0}, kMax, kMax}) {
        histogram.add(value);
    }
    EXPECT_EQ(histogram.min_ms(), static_cast<double>(kMin) / 1e6);
    EXPECT_EQ(histogram.max_ms(), static_cast<double>(kMax) / 1e6);
    EXPECT_EQ(histogram.percentile_ms(50.0), 0.0);
    EXPECT_NEAR(*histogram.percentile_ms(20.0), *histogram.min_ms(), 0.07 * *histogram.max_ms());
    EXPECT_NEAR(*histogram.percentile_ms(80.0), *histogram.max_ms(), 0.07 * *histogram.max_ms());
    EXPECT_NEAR(*histogram.mean_ms(), -2.0 / 5.0 / 1e6, 1e-12);
}

TEST(DurationHistogram, NegativeSamplesComeFirst) {
    DurationHistogram histogram;
    for (int i = 0; i < 50; ++i) {
        histogram.add(-1'000'000);
        histogram.add(2'000'000);
    }
    EXPECT_NEAR(*histogram.percentile_ms(50.0), -1.0, 0.002);
    EXPECT_NEAR(*histogram.percentile_ms(51.0), 2.0, 0.004);
}

}  // namespace
}  // namespace gazeloop::latency
