#include "runtime/report/duration_column.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <numeric>
#include <random>
#include <vector>

namespace gazeloop::report {
namespace {

constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
constexpr std::int64_t kGreatest = std::numeric_limits<std::int64_t>::max();
constexpr std::int64_t kFar = std::int64_t{1} << 31;

void expect_kept(const std::vector<std::optional<std::int64_t>>& numbers) {
    NumberColumn column;
    for (const auto& number : numbers) {
        column.add(number);
    }
    ASSERT_EQ(column.size(), numbers.size());
    for (std::size_t row = 0; row < numbers.size(); ++row) {
        ASSERT_EQ(column.at(row), numbers[row]) << "row " << row;
    }
}

TEST(NumberColumn, KeepsEveryNumberExactly) {
    expect_kept({});
    expect_kept({std::nullopt});
    expect_kept({kLeast, std::nullopt, kGreatest, 0, -1, kLeast});
    expect_kept({std::nullopt, 5, 5, kFar + 5, kFar + 4, -kFar + 5, -kFar + 6});
    expect_kept({kGreatest, kGreatest - 1, kLeast, kLeast + 1, std::nullopt});
}

TEST(NumberColumn, KeepsAnyMixtureOverManyBlocks) {
    std::mt19937_64 random(7);
    std::vector<std::optional<std::int64_t>> numbers;
    for (int stretch = 0; stretch < 60; ++stretch) {
        const auto length = random() % 900;
        const auto shift = random() % 64;
        const bool alike = random() % 3 == 0;
        auto number = std::optional(static_cast<std::int64_t>(random() >> shift));
        for (std::uint64_t row = 0; row < length; ++row) {
            if (!alike) {
                number = random() % 5 == 0
                             ? std::nullopt
                             : std::optional(static_cast<std::int64_t>(random() >> shift));
            }
            numbers.push_back(number);
        }
    }
    expect_kept(numbers);
}

DurationColumn column_of(const std::vector<std::int64_t>& numbers) {
    DurationColumn column("key", "label");
    for (const std::int64_t ns : numbers) {
        column.add({ns, time::StampKind::Measured});
    }
    return column;
}

TEST(DurationColumn, CountsKindsAndUnknownsAndWhatItIsNotAbout) {
    DurationColumn column("key", "label");
    column.add({-3, time::StampKind::Predicted});
    column.add({});
    column.skip();
    column.add({7, time::StampKind::Measured});
    EXPECT_EQ(column.size(), 4U);
    EXPECT_EQ(column.known(), 2U);
    EXPECT_EQ(column.negative(), 1U);
    EXPECT_EQ(column.frames_by_kind()[static_cast<std::size_t>(time::StampKind::Unknown)], 1U);
    EXPECT_EQ(column.at(1), std::nullopt);
    EXPECT_EQ(column.least(), -3);
    EXPECT_EQ(column.greatest(), 7);
    EXPECT_EQ(column.mean(), 2.0);
    column.forget();
    EXPECT_EQ(column.size(), 4U);
    EXPECT_EQ(column.known(), 0U);
    EXPECT_EQ(column.negative(), 0U);
    EXPECT_EQ(column.frames_by_kind()[static_cast<std::size_t>(time::StampKind::Unknown)], 3U);
    EXPECT_EQ(column.mean(), std::nullopt);
    EXPECT_EQ(column.key(), "key");
}

TEST(DurationColumn, OfNothingHasNothing) {
    const DurationColumn column("key", "label");
    constexpr std::array kPercents{50.0};
    EXPECT_EQ(column.least(), std::nullopt);
    EXPECT_EQ(column.greatest(), std::nullopt);
    EXPECT_EQ(column.mean(), std::nullopt);
    EXPECT_EQ(column.percentiles(kPercents)[0], std::nullopt);
    EXPECT_TRUE(column.bins(0, 0, 10).empty());
}

// Their sum does not fit.
TEST(DurationColumn, TakesTheMeanOfTheGreatestNumbers) {
    EXPECT_EQ(column_of({kGreatest, kGreatest, kGreatest}).mean(), static_cast<double>(kGreatest));
}

TEST(DurationColumn, TakesPercentilesByNearestRankAndWithholdsThoseOfTooFew) {
    std::vector<std::int64_t> numbers(999);
    std::iota(numbers.begin(), numbers.end(), 1);
    std::ranges::shuffle(numbers, std::mt19937_64(3));
    constexpr std::array kPercents{99.9, 0.1, 50.0, 99.0, 0.0, 100.0, -1.0};
    EXPECT_EQ(column_of(numbers).percentiles(kPercents),
              (std::vector<std::optional<std::int64_t>>{std::nullopt, 1, 500, 990, std::nullopt,
                                                        std::nullopt, std::nullopt}));
    numbers.push_back(1000);
    EXPECT_EQ(column_of(numbers).percentiles(kPercents)[0], 999);
}

TEST(DurationColumn, LosesNoSpikeInBins) {
    constexpr std::size_t kRows = 10'007;
    DurationColumn column("key", "label");
    for (std::size_t row = 0; row < kRows; ++row) {
        if (row % 7 == 0) {
            column.add({});
        } else {
            column.add({row == 4321 ? kFar : 10, time::StampKind::Measured});
        }
    }
    for (const std::size_t count : {std::size_t{1}, std::size_t{3}, std::size_t{1000}, kRows * 2}) {
        const std::vector<Bin> bins = column.bins(0, kRows, count);
        ASSERT_EQ(bins.size(), std::min(count, kRows));
        std::size_t next = 0;
        std::size_t known = 0;
        std::int64_t greatest = 0;
        for (const Bin& bin : bins) {
            EXPECT_EQ(bin.first, next);
            EXPECT_GT(bin.end, bin.first);
            next = bin.end;
            known += bin.known;
            greatest = bin.known > 0 ? std::max(greatest, bin.greatest) : greatest;
        }
        EXPECT_EQ(next, kRows);
        EXPECT_EQ(known, column.known());
        EXPECT_EQ(greatest, kFar);
    }
    const std::vector<Bin> unknown = column.bins(7, 8, 5);
    ASSERT_EQ(unknown.size(), 1U);
    EXPECT_EQ(unknown[0].known, 0U);
}

}  // namespace
}  // namespace gazeloop::report
