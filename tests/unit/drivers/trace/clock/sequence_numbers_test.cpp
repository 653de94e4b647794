#include "drivers/trace/clock/sequence_numbers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>

#include "tests/unit/drivers/trace/clock/trace_rows.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using ::testing::ElementsAre;
using ::testing::ElementsAreArray;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<TraceRow> numbered(const std::vector<std::uint64_t>& numbers) {
    auto rows = good_rows(numbers.size());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].sequence = numbers[i];
    }
    return rows;
}

SequenceNumbers of(const std::vector<TraceRow>& rows) {
    return sequence_numbers(RowsRead{rows}, device_times(RowsRead{rows}, 1.0));
}

TEST(SequenceNumbers, StayWhereTheyCountUp) {
    const SequenceNumbers sequence = of(numbered({7, 8, 9, 12, 13}));
    EXPECT_THAT(sequence.numbers, ElementsAre(7, 8, 9, 12, 13));
    EXPECT_EQ(sequence.lost, 2U);
    EXPECT_THAT(sequence.findings, IsEmpty());
    EXPECT_THAT(of(numbered({18'446'744'073'709'551'614U, 18'446'744'073'709'551'615U})).numbers,
                ElementsAre(18'446'744'073'709'551'614U, 18'446'744'073'709'551'615U));
    EXPECT_THAT(of(numbered({42})).numbers, ElementsAre(42));
}

TEST(SequenceNumbers, AreCountedWhereThereAreNone) {
    EXPECT_THAT(of(without_sequence(good_rows(4))).numbers, ElementsAre(0, 1, 2, 3));
    const SequenceNumbers constant = of(numbered({5, 5, 5, 5}));
    EXPECT_THAT(constant.numbers, ElementsAre(0, 1, 2, 3));
    EXPECT_THAT(constant.findings, IsEmpty());
    EXPECT_EQ(constant.lost, std::nullopt) << "nobody knows";
    EXPECT_EQ(of(without_sequence(good_rows(4))).lost, std::nullopt);
}

TEST(SequenceNumbers, AreCountedOnOverAWrap) {
    for (const std::uint64_t range :
         {std::uint64_t{1} << 8, std::uint64_t{1} << 16, std::uint64_t{1} << 32}) {
        const SequenceNumbers sequence =
            of(numbered({range - 3, range - 2, range - 1, 0, 1, 4, 5}));
        EXPECT_THAT(sequence.numbers, ElementsAre(range - 3, range - 2, range - 1, range, range + 1,
                                                  range + 4, range + 5));
        EXPECT_EQ(sequence.lost, 2U);
        ASSERT_THAT(sequence.findings, SizeIs(1));
        EXPECT_EQ(sequence.findings[0].kind, TraceFindingKind::SequenceRestarted);
        EXPECT_EQ(sequence.findings[0].line, 5U);
        // The wrap itself fell into a loss of two.
        EXPECT_EQ(of(numbered({range - 3, range - 2, 1, 2})).lost, 2U);
    }
}

TEST(SequenceNumbers, AreCountedOnWhereTheyBeginAnew) {
    const SequenceNumbers sequence = of(numbered({700, 701, 702, 0, 1, 3, 4}));
    EXPECT_THAT(sequence.numbers, ElementsAre(700, 701, 702, 703, 704, 706, 707));
    EXPECT_EQ(sequence.lost, 1U);
    ASSERT_THAT(sequence.findings, SizeIs(1));
    EXPECT_EQ(sequence.findings[0].kind, TraceFindingKind::SequenceRestarted);
    // Ahead, too, where there was no time for so many.
    const SequenceNumbers ahead = of(numbered({1, 2, 3, 4'000'000'000, 4'000'000'001}));
    EXPECT_THAT(ahead.numbers, ElementsAre(1, 2, 3, 4, 5));
    EXPECT_EQ(ahead.lost, 0U);
    EXPECT_THAT(of_kind(ahead.findings, TraceFindingKind::SequenceRestarted), SizeIs(1));
}

TEST(SequenceNumbers, LeaveOneAbsurdNumberOut) {
    for (const std::uint64_t absurd :
         {std::uint64_t{0}, std::uint64_t{4'294'967'295}, ~std::uint64_t{0}}) {
        for (const std::size_t at : {0U, 1U, 5U, 8U}) {
            std::vector<std::uint64_t> numbers(10);
            std::iota(numbers.begin(), numbers.end(), 1000);
            const std::vector<std::uint64_t> good = numbers;
            numbers[at] = absurd;
            const SequenceNumbers sequence = of(numbered(numbers));
            EXPECT_THAT(sequence.numbers, ElementsAreArray(good)) << absurd << ' ' << at;
            EXPECT_EQ(sequence.lost, 0U);
            ASSERT_THAT(sequence.findings, SizeIs(1));
            EXPECT_EQ(sequence.findings[0].kind, TraceFindingKind::SequenceOutlier);
            EXPECT_EQ(sequence.findings[0].line, at + 2);
        }
    }
}

TEST(SequenceNumbers, LoseWhatALongGapHasRoomFor) {
    auto rows = good_rows(100);
    move_times(rows, 50, 100, 60 * kSecond);
    for (std::size_t i = 50; i < 100; ++i) {
        *rows[i].sequence += 7'200;
    }
    const SequenceNumbers sequence = of(rows);
    EXPECT_EQ(sequence.lost, 7'200U);
    EXPECT_EQ(sequence.numbers.back(), 7'299U);
}

TEST(SequenceNumbers, DoNotLoseWhatTheReaderDropped) {
    auto rows = good_rows(800);
    move_times(rows, 500, 502, 2'500 * kMs);
    rows.erase(rows.begin() + 600, rows.begin() + 603);
    const SequenceNumbers sequence = of(rows);
    EXPECT_EQ(sequence.lost, 3U);
    EXPECT_EQ(sequence.numbers.size(), 795U);
    EXPECT_EQ(sequence.numbers.back(), 797U);
}

TEST(SequenceNumbers, DoNotTakeARestartForAWrap) {
    for (const std::uint64_t last : {std::uint64_t{239}, std::uint64_t{1'999}}) {
        auto rows = good_rows(last + 101);
        for (std::size_t i = last + 1; i < rows.size(); ++i) {
            *rows[i].sequence -= last + 1;
        }
        for (const bool late : {false, true}) {
            if (late) {
                move_times(rows, last + 1, rows.size(), 200 * kSecond);
            }
            const SequenceNumbers sequence = of(rows);
            EXPECT_EQ(sequence.lost, late ? std::nullopt : std::optional{0U})
                << last << ": nobody knows what was lost in a gap";
            EXPECT_EQ(sequence.numbers.back(), last + 100);
            ASSERT_THAT(sequence.findings, SizeIs(1));
            EXPECT_THAT(sequence.findings[0].text, HasSubstr("begins anew, 0 after"));
        }
    }
}

TEST(SequenceNumbers, TakeWhatTheTimeAgreesWithForAWrap) {
    // 200 is not near 256, but 60 reports' time went by, and 60 is what a wrap makes.
    auto rows = good_rows(300);
    for (TraceRow& row : rows) {
        *row.sequence = (*row.sequence + 101) % 256;
    }
    rows.erase(rows.begin() + 100, rows.begin() + 159);
    const SequenceNumbers sequence = of(rows);
    EXPECT_EQ(sequence.lost, 59U);
    EXPECT_EQ(sequence.numbers.back(), 400U);
    ASSERT_THAT(sequence.findings, SizeIs(1));
    EXPECT_THAT(sequence.findings[0].text, HasSubstr("wraps from 200 to 4"));
}

TEST(SequenceNumbers, AreSaidNotToCountOnce) {
    auto descending = good_rows(200);
    auto random = good_rows(200);
    for (std::size_t i = 0; i < 200; ++i) {
        descending[i].sequence = 5'000 - i;
        random[i].sequence = i * 7'919'000'017U % 1'000'003U;
    }
    for (const auto& rows : {descending, random}) {
        const SequenceNumbers sequence = of(rows);
        EXPECT_EQ(sequence.lost, std::nullopt);
        EXPECT_EQ(sequence.numbers.front(), 0U);
        EXPECT_EQ(sequence.numbers.back(), 199U);
        ASSERT_THAT(sequence.findings, SizeIs(1));
        EXPECT_EQ(sequence.findings[0].kind, TraceFindingKind::SequenceOutlier);
        EXPECT_EQ(sequence.findings[0].line, 3U);
        EXPECT_THAT(sequence.findings[0].text, HasSubstr("the sequence does not count: "));
    }
}

TEST(SequenceNumbers, MayBeginWithOneTwice) {
    const SequenceNumbers sequence = of(numbered({5, 5, 6, 7, 8}));
    EXPECT_THAT(sequence.numbers, ElementsAre(5, 6, 7, 8, 9));
    EXPECT_THAT(sequence.findings, IsEmpty());
}

TEST(SequenceNumbers, DoNotLoseRowsThatWereFiledLate) {
    auto rows = good_rows(800);
    std::rotate(rows.begin() + 300, rows.begin() + 320, rows.begin() + 420);
    const SequenceNumbers sequence = of(rows);
    EXPECT_EQ(sequence.lost, 0U);
    ASSERT_EQ(sequence.numbers.size(), 800U);
    EXPECT_EQ(sequence.numbers.back(), 799U);
    ASSERT_THAT(sequence.findings, SizeIs(1));
    EXPECT_EQ(sequence.findings[0].line, 302U);
    EXPECT_THAT(sequence.findings[0].text, HasSubstr("20 rows of a gap further up, 300 to 319"));
}

TEST(SequenceNumbers, DoNotLoseRowsThatWereFiledLateWhereTheyWrap) {
    for (const std::vector<std::uint64_t>& swapped :
         {std::vector<std::uint64_t>{252, 253, 254, 0, 255, 1, 2, 3},
          std::vector<std::uint64_t>{253, 254, 255, 1, 0, 2, 3, 4},
          std::vector<std::uint64_t>{252, 253, 254, 2, 255, 0, 1, 3}}) {
        const SequenceNumbers sequence = of(numbered(swapped));
        EXPECT_EQ(sequence.lost, 0U);
        ASSERT_THAT(sequence.numbers, SizeIs(swapped.size()));
        EXPECT_EQ(sequence.numbers.back() - sequence.numbers.front(), swapped.size() - 1);
        ASSERT_THAT(sequence.findings, SizeIs(2));
        EXPECT_THAT(sequence.findings[0].text, HasSubstr("wraps"));
        EXPECT_THAT(sequence.findings[1].text, HasSubstr("filed late"));
    }
}

TEST(SequenceNumbers, DoNotLoseRowsThatWereFiledLateAndLeftOut) {
    auto rows = good_rows(800);
    std::rotate(rows.begin() + 300, rows.begin() + 310, rows.begin() + 410);
    const SequenceNumbers sequence = of(rows);
    EXPECT_EQ(sequence.lost, 0U);
    EXPECT_EQ(sequence.numbers.back(), 789U);
}

TEST(SequenceNumbers, ThatGoOnByTwoSayNothingOfLosses) {
    auto rows = good_rows(600);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].sequence = 2 * i + (i < 400 ? 0 : 6);
    }
    const SequenceNumbers sequence = of(rows);
    EXPECT_EQ(sequence.lost, std::nullopt);
    EXPECT_EQ(sequence.numbers.back(), 599U);
    ASSERT_THAT(sequence.findings, SizeIs(1));
    EXPECT_EQ(sequence.findings[0].kind, TraceFindingKind::SequenceOutlier);
    EXPECT_THAT(sequence.findings[0].text, HasSubstr("goes on by 2 from row to row"));
    // Every other report lost for a while is a loss.
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].sequence = i < 200 ? 2 * i : 200 + i;
        *rows[i].device_ticks = static_cast<std::int64_t>(*rows[i].sequence) * 8'333'333;
    }
    EXPECT_EQ(of(rows).lost, 200U);
}

}  // namespace
}  // namespace gazeloop::drivers
