#include "runtime/statistics/block_bootstrap.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <random>
#include <vector>

namespace gazeloop::statistics {
namespace {

/// Standard normal numbers, the same with every library (Box and Muller).
class Normal {
  public:
    explicit Normal(std::uint64_t seed) : random_(seed) {}
    double operator()() {
        const double u = (static_cast<double>(random_() >> 11U) + 0.5) * 0x1p-53;
        const double v = (static_cast<double>(random_() >> 11U) + 0.5) * 0x1p-53;
        return std::sqrt(-2.0 * std::log(u)) * std::cos(6.283185307179586 * v);
    }

  private:
    std::mt19937_64 random_;
};

/// Neighbours correlate by `correlation`; each value is standard normal about `mean`.
std::vector<double> correlated(std::size_t count, double correlation, double mean,
                               std::uint64_t seed) {
    Normal normal(seed);
    std::vector<double> values(count);
    double state = normal();
    for (double& value : values) {
        value = mean + state;
        state = correlation * state + std::sqrt(1.0 - correlation * correlation) * normal();
    }
    return values;
}

TEST(BlockLength, GrowsWithTheCorrelationOfNeighbours) {
    // The rule's optimum for such a process of correlation a: (6 n a^2 / (1 - a^2)^2)^(1/3).
    for (const double a : {0.5, 0.8, 0.95}) {
        const std::size_t count = 20'000;
        const double best =
            std::cbrt(6.0 * static_cast<double>(count) * a * a / std::pow(1.0 - a * a, 2));
        double sum = 0.0;
        for (std::uint64_t seed = 1; seed <= 20; ++seed) {
            sum += static_cast<double>(block_length(correlated(count, a, 0.0, seed)));
        }
        EXPECT_NEAR(sum / 20 / best, 1.0, 0.3) << "correlation " << a;
    }
}

TEST(BlockLength, IsShortForIndependentAndForEqualValues) {
    EXPECT_LE(block_length(correlated(10'000, 0.0, 0.0, 3)), 12U);
    EXPECT_EQ(block_length(std::vector<double>(1'000, 7.0)), 1U);
    EXPECT_EQ(block_length({}), 1U);
    EXPECT_EQ(block_length(std::vector<double>{1.0}), 1U);
    EXPECT_EQ(block_length(std::vector<double>{1.0, 2.0, 3.0, 4.0}), 1U);
}

TEST(BlockLength, OfALongRunIsFoundFromAverages) {
    const std::size_t length = block_length(correlated(200'000, 0.99, 0.0, 5));
    EXPECT_GT(length, 500U);
    EXPECT_LT(length, 20'000U);
}

struct Figure {
    const char* name;
    std::function<std::optional<Difference>(std::span<const double>, std::span<const double>,
                                            const BootstrapOptions&)>
        difference;
};

std::vector<Figure> figures() {
    std::vector<Figure> list{{"mean", difference_of_means}};
    for (const auto& [name, percent] : {std::pair{"p50", 50.0}, {"p95", 95.0}}) {
        list.push_back(
            {name, [percent](std::span<const double> before, std::span<const double> after,
                             const BootstrapOptions& options) {
                 return difference_of_percentiles(before, after, percent, options);
             }});
    }
    return list;
}

// 95 of 100 intervals shall hold the truth. Resampling single values would leave half of them
// wrong at this correlation.
TEST(BlockBootstrap, IntervalsHoldTheTruth) {
    constexpr int kRuns = 100;
    constexpr double kShift = 0.3;
    for (const double correlation : {0.0, 0.8}) {
        for (const Figure& figure : figures()) {
            int held = 0;
            for (std::uint64_t run = 0; run < kRuns; ++run) {
                const auto difference =
                    figure.difference(correlated(1'500, correlation, 0.0, 2 * run + 1),
                                      correlated(1'000, correlation, kShift, 2 * run + 2),
                                      {.seed = run, .resamples = 200});
                ASSERT_TRUE(difference);
                held += difference->low <= kShift && kShift <= difference->high ? 1 : 0;
            }
            EXPECT_GE(held, kRuns * 86 / 100) << figure.name << ", correlation " << correlation;
            EXPECT_LE(held, kRuns * 99 / 100) << figure.name << ", correlation " << correlation;
        }
    }
}

TEST(BlockBootstrap, SameRunsDifferByNothing) {
    const std::vector<double> values = correlated(2'000, 0.7, 11.0, 4);
    for (const Figure& figure : figures()) {
        const auto difference = figure.difference(values, values, {});
        ASSERT_TRUE(difference);
        EXPECT_EQ(difference->change(), 0.0);
        EXPECT_TRUE(difference->may_be_chance());
    }
}

TEST(BlockBootstrap, SeesWhatIsNoChance) {
    for (const Figure& figure : figures()) {
        const auto difference =
            figure.difference(correlated(4'000, 0.8, 0.0, 1), correlated(4'000, 0.8, 1.0, 2), {});
        ASSERT_TRUE(difference);
        EXPECT_FALSE(difference->may_be_chance());
        EXPECT_NEAR(difference->change(), 1.0, 0.4);
        EXPECT_LE(difference->low, difference->change());
        EXPECT_GE(difference->high, difference->change());
    }
}

TEST(BlockBootstrap, IsTheSameForTheSameSeed) {
    const std::vector<double> before = correlated(1'000, 0.5, 0.0, 1);
    const std::vector<double> after = correlated(1'000, 0.5, 0.1, 2);
    const auto once = difference_of_means(before, after, {.seed = 9});
    const auto again = difference_of_means(before, after, {.seed = 9});
    const auto other = difference_of_means(before, after, {.seed = 10});
    EXPECT_EQ(once->low, again->low);
    EXPECT_EQ(once->high, again->high);
    EXPECT_NE(once->low, other->low);
}

TEST(BlockBootstrap, BoundsNothingWithTooFewValues) {
    const std::vector<double> enough = correlated(1'000, 0.0, 0.0, 1);
    EXPECT_FALSE(difference_of_means({}, enough));
    EXPECT_FALSE(difference_of_means(enough, {}));
    EXPECT_FALSE(difference_of_means(enough, std::vector<double>{1.0, 2.0, 3.0}));
    EXPECT_TRUE(difference_of_percentiles(enough, enough, 99.0));
    EXPECT_FALSE(difference_of_percentiles(enough, enough, 99.1)) << "nine lie beyond it";
    EXPECT_FALSE(difference_of_percentiles(enough, enough, 0.5));
    EXPECT_FALSE(difference_of_percentiles(enough, enough, 100.0));
    EXPECT_FALSE(
        difference_of_percentiles(enough, enough, std::numeric_limits<double>::quiet_NaN()));
}

TEST(BlockBootstrap, EqualValuesLeaveNoDoubt) {
    const std::vector<double> before(100, 3.0);
    const std::vector<double> after(100, 5.0);
    for (const Figure& figure : figures()) {
        if (const auto difference = figure.difference(before, after, {})) {
            EXPECT_EQ(difference->low, 2.0) << figure.name;
            EXPECT_EQ(difference->high, 2.0) << figure.name;
        }
    }
}

}  // namespace
}  // namespace gazeloop::statistics
