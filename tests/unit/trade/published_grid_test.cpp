#include "runtime/trade/published_grid.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace gazeloop::trade {
namespace {

TEST(PublishedGrid, IsThePilotStudysAndFigure4s) {
    const std::vector<SweepPoint> points = published_grid();
    EXPECT_EQ(points.size(), 14U * 4U + 2U);
    EXPECT_NE(std::ranges::find(points, published_choice()), points.end());
}

/// With a figure that grows with sigma and falls with alpha, as the paper found.
std::vector<SweepRow> rows() {
    std::vector<SweepRow> all;
    for (const SweepPoint& point : published_grid()) {
        SweepRow row;
        row.point = point;
        row.figures = {{.key = "contrast",
                        .meaning = "",
                        .mean = std::stod(point.settings[0].second) -
                                0.25 * std::stod(point.settings[1].second)}};
        all.push_back(std::move(row));
    }
    return all;
}

TEST(PublishedGrid, SaysUpToWhereOtherPointsAreAsGoodAsTheChoice) {
    const std::vector<std::string> lines = against_published(rows());
    ASSERT_EQ(lines.size(), 5U);
    EXPECT_THAT(lines[0], testing::HasSubstr("contrast 0.8"));
    EXPECT_EQ(lines[1], "alpha 1: no worse than that up to sigma 1.0, worse at 1.2");
    EXPECT_EQ(lines[4], "alpha 4: no worse than that up to sigma 1.8, worse at 2.0");
    std::vector<SweepRow> without = rows();
    std::erase_if(without, [](const SweepRow& row) { return row.point == published_choice(); });
    EXPECT_TRUE(against_published(without).empty());
    EXPECT_TRUE(against_published({}).empty());
    for (SweepRow& row : without) {
        row.error = "failed";
    }
    EXPECT_TRUE(against_published(without).empty());
}

}  // namespace
}  // namespace gazeloop::trade
