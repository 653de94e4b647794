#include "drivers/trace/clock/row_order.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <numeric>
#include <random>
#include <string>

#include "tests/unit/drivers/trace/clock/trace_rows.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::int64_t kInterval = 8'333'333;

struct Ordered {
    RowOrder order;
    std::vector<Wide> at_ns;
};

Ordered ordered(const std::vector<TraceRow>& rows) {
    Ordered found;
    for (const TraceRow& row : rows) {
        found.at_ns.push_back(*row.device_ticks);
    }
    memory::LongVector<std::size_t> all(rows.size());
    std::iota(all.begin(), all.end(), 0U);
    found.order = rows_in_order(RowsRead{rows}, found.at_ns, all, kInterval);
    return found;
}

/// Whether the rows stand in the order of their lines, without one missing.
bool by_line(const std::vector<TraceRow>& rows, const Ordered& found) {
    for (std::size_t i = 0; i < found.order.rows.size(); ++i) {
        if (rows[found.order.rows[i]].line != i + 2) {
            return false;
        }
    }
    return found.order.rows.size() == rows.size();
}

TEST(RowOrder, MendsSwapsSideBySide) {
    for (const std::size_t end : {404U, 800U}) {
        auto rows = without_sequence(good_rows(800));
        for (std::size_t i = 400; i < end; i += 2) {
            std::swap(rows[i], rows[i + 1]);
        }
        const Ordered found = ordered(rows);
        EXPECT_TRUE(by_line(rows, found));
        EXPECT_THAT(found.order.findings, SizeIs((end - 400) / 2));
    }
}

TEST(RowOrder, MendsShuffledWindows) {
    std::mt19937 random(7);
    for (std::size_t window = 2; window <= 8; ++window) {
        auto rows = without_sequence(good_rows(800));
        for (std::size_t i = 0; i + window <= rows.size(); i += window) {
            const auto first = rows.begin() + static_cast<std::ptrdiff_t>(i);
            std::shuffle(first, first + static_cast<std::ptrdiff_t>(window), random);
        }
        EXPECT_TRUE(by_line(rows, ordered(rows))) << window;
    }
}

TEST(RowOrder, MendsTwoStreamsOfWhichOneIsLate) {
    auto rows = without_sequence(good_rows(800));
    std::stable_sort(rows.begin(), rows.end(), [](const TraceRow& a, const TraceRow& b) {
        const auto filed = [](const TraceRow& row) {
            return *row.device_ticks + (row.line % 2 == 0 ? 0 : 9 * kInterval / 4);
        };
        return filed(a) < filed(b);
    });
    EXPECT_TRUE(by_line(rows, ordered(rows)));
}

std::vector<TraceRow> jittering() {
    std::mt19937 random(3);
    std::normal_distribution<double> jitter(0.0, 0.5 * static_cast<double>(kInterval));
    auto rows = good_rows(2'000);
    for (TraceRow& row : rows) {
        *row.device_ticks += static_cast<std::int64_t>(jitter(random));
    }
    return rows;
}

/// Whether all rows are there, and their times do not go back.
bool rises(const std::vector<TraceRow>& rows, const Ordered& found) {
    return found.order.rows.size() == rows.size() &&
           std::is_sorted(
               found.order.rows.begin(), found.order.rows.end(),
               [&](std::size_t a, std::size_t b) { return found.at_ns[a] < found.at_ns[b]; });
}

TEST(RowOrder, LevelsTimesThatJitterWhileNumbersCountOn) {
    const auto rows = jittering();
    const Ordered found = ordered(rows);
    EXPECT_TRUE(by_line(rows, found));
    EXPECT_TRUE(rises(rows, found));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ASSERT_LE(std::abs(static_cast<std::int64_t>(found.at_ns[i]) - *rows[i].device_ticks),
                  3 * kInterval);
    }
    ASSERT_FALSE(found.order.findings.empty());
    for (const gaze::TraceFinding& finding : found.order.findings) {
        EXPECT_EQ(finding.kind, TraceFindingKind::OutOfOrder);
        EXPECT_EQ(finding.dropped, 0U);
        EXPECT_THAT(finding.text, HasSubstr("go back while the rows count on: levelled by up to"));
    }
}

TEST(RowOrder, LevelsTimesThatJitterWhileTheHostCountsOn) {
    auto rows = without_sequence(jittering());
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].host_ns = static_cast<std::int64_t>(i) * kInterval;
    }
    const Ordered found = ordered(rows);
    EXPECT_TRUE(rises(rows, found));
    EXPECT_TRUE(std::any_of(
        found.order.findings.begin(), found.order.findings.end(),
        [](const auto& finding) { return finding.text.find("levelled") != std::string::npos; }));
}

TEST(RowOrder, PutsRowsThatJitterInTheOrderOfTheirTimesForWantOfAnother) {
    const auto rows = without_sequence(jittering());
    const Ordered found = ordered(rows);
    EXPECT_TRUE(rises(rows, found));
    for (std::size_t i = 0; i < rows.size(); ++i) {
        ASSERT_EQ(found.at_ns[i], Wide{*rows[i].device_ticks});
    }
}

TEST(RowOrder, LeavesAStepBackOfAnEvenClockToOthers) {
    auto rows = good_rows(800);
    move_times(rows, 400, 401, 3 * kInterval / 2);
    const Ordered found = ordered(rows);
    EXPECT_TRUE(by_line(rows, found));
    EXPECT_THAT(found.order.findings, IsEmpty());
    EXPECT_EQ(found.at_ns[400], *rows[400].device_ticks);
}

TEST(RowOrder, LeavesAStepBackOfACoarseClockToOthers) {
    auto rows = good_rows(800);
    for (std::size_t i = 0; i < rows.size(); ++i) {
        rows[i].device_ticks = static_cast<std::int64_t>(i / 8) * kInterval;
    }
    move_times(rows, 400, 401, 2 * kInterval);
    const Ordered found = ordered(rows);
    EXPECT_THAT(found.order.findings, IsEmpty());
    EXPECT_EQ(found.at_ns[400], *rows[400].device_ticks);
}

}  // namespace
}  // namespace gazeloop::drivers
