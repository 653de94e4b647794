#include "drivers/trace/clock/standing_gaze.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/unit/drivers/trace/clock/trace_rows.h"

namespace gazeloop::drivers {
namespace {

using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

std::vector<gaze::TraceFinding> of(const std::vector<TraceRow>& rows) {
    return standing_gaze(RowsRead{rows}, device_times(RowsRead{rows}, 1.0));
}

/// 600 rows of which those from 300 on hold the report of row 300.
std::vector<TraceRow> frozen() {
    auto rows = good_rows(600);
    for (std::size_t i = 301; i < 600; ++i) {
        rows[i].eyes = rows[300].eyes;
        rows[i].sequence = rows[300].sequence;
    }
    return rows;
}

TEST(StandingGaze, IsSaidWhereTimeGoesOn) {
    EXPECT_THAT(of(good_rows(600)), IsEmpty());
    for (const auto& rows : {frozen(), without_sequence(frozen())}) {
        const auto findings = of(rows);
        ASSERT_THAT(findings, SizeIs(1));
        EXPECT_EQ(findings[0].kind, gaze::TraceFindingKind::Repeat);
        EXPECT_EQ(findings[0].line, 303U);
        EXPECT_EQ(findings[0].rows, 299U);
        EXPECT_EQ(findings[0].dropped, 0U);
        EXPECT_EQ(findings[0].span_ns, 299 * std::int64_t{8'333'333});
    }
}

TEST(StandingGaze, IsNoneWhereNumbersCountOnOrEyesAreShut) {
    auto counting = frozen();
    auto shut = frozen();
    for (std::size_t i = 0; i < 600; ++i) {
        counting[i].sequence = i;
        shut[i].eyes[0].valid = shut[i].eyes[1].valid = i < 300;
    }
    EXPECT_THAT(of(counting), IsEmpty());
    EXPECT_THAT(of(shut), IsEmpty());
}

TEST(StandingGaze, IsNoneInFixationsWithoutNoise) {
    auto rows = good_rows(600);
    for (std::size_t i = 0; i < 600; ++i) {
        rows[i].eyes = rows[i / 96 * 96].eyes;  // .8 s each
        rows[i].sequence.reset();
    }
    EXPECT_THAT(of(rows), IsEmpty());
}

TEST(StandingGaze, IsNoWarningWhereItIsTheWholeFile) {
    auto rows = good_rows(600);
    for (TraceRow& row : rows) {
        row.eyes = rows[0].eyes;
        row.sequence.reset();
    }
    const auto findings = of(rows);
    ASSERT_THAT(findings, SizeIs(1));
    EXPECT_EQ(findings[0].kind, gaze::TraceFindingKind::Text);
    EXPECT_EQ(findings[0].line, 2U);
}

TEST(StandingGaze, SaysThatARecorderPolls) {
    auto rows = good_rows(600);
    for (std::size_t i = 1; i < 600; i += 2) {
        rows[i].eyes = rows[i - 1].eyes;
        rows[i].sequence = rows[i - 1].sequence;
    }
    const auto findings = of(rows);
    ASSERT_THAT(findings, SizeIs(1));
    EXPECT_EQ(findings[0].line, 3U);
    EXPECT_EQ(findings[0].rows, 300U);
    EXPECT_EQ(findings[0].dropped, 0U);
    EXPECT_THAT(findings[0].text, HasSubstr("300 of 600 rows repeat the report before"));
}

}  // namespace
}  // namespace gazeloop::drivers
