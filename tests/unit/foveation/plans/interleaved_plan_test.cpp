#include "runtime/foveation/plans/interleaved_plan.h"

#include <gtest/gtest.h>

#include <set>

#include "runtime/foveation/plans/kfr_plan.h"
#include "tests/unit/foveation/picture/masks.h"

namespace gazeloop::foveation {
namespace {

TEST(CellTurns, GiveEveryPlaceOfABlockItsTurn) {
    for (const std::uint32_t every : CellTurns::kEvery) {
        const CellTurns turns{every};
        EXPECT_EQ(turns.block_width() * turns.block_height(), every);
        std::set<std::pair<std::uint32_t, std::uint32_t>> places;
        for (std::uint64_t frame = 5; frame < 5 + every; ++frame) {
            const CellTurns::Place place = turns.place(frame);
            EXPECT_LT(place.x, turns.block_width());
            EXPECT_LT(place.y, turns.block_height());
            places.emplace(place.x, place.y);
            EXPECT_EQ(place, turns.place(frame + every));
        }
        EXPECT_EQ(places.size(), every);
        EXPECT_EQ(turns.columns(1), 1U);
        EXPECT_EQ(turns.rows(0), 0U);
    }
}

// Every texel that the picture reads lies in a block whose cell is shaded.
TEST(InterleavedPlan, ShadesABlockOfEveryTexelThatIsRead) {
    constexpr std::uint32_t kSide = 250;
    const gaze::EyeView view = tests::square_view(kSide, kSide);
    const HiddenArea hidden(tests::cut_corners(0.2), view);
    for (const std::uint32_t every : CellTurns::kEvery) {
        const CellTurns turns{every};
        InterleavedPlan method(std::make_unique<KfrPlan>(KfrParameters{.aspect = 0.35}), turns,
                               turns);
        ASSERT_TRUE(method.prepare({view, view}));
        for (const double x_px : {125.0, 0.0, 400.0}) {
            gaze::FoveaPoint fovea;
            fovea.position = {x_px, 90.0};
            EyePlan plan;
            method.plan(gaze::Eye::Left, view, fovea, &hidden, {}, plan);
            const std::uint32_t heights[] = {method.whole().lp(gaze::Eye::Left).height, kSide};
            std::size_t word = 0;
            for (std::size_t grid = 0; grid < 2; ++grid) {
                for (std::uint32_t y = 0; y < heights[grid]; ++y) {
                    const std::size_t at = word + 2 * std::size_t{y / kBandRows};
                    const std::uint32_t row = y / turns.block_height();
                    for (std::uint32_t x = plan.table[at]; x < plan.table[at + 1]; ++x) {
                        const Columns& cells = plan.grids[grid].bands.at(row / kBandRows);
                        const std::uint32_t column = x / turns.block_width();
                        ASSERT_TRUE(cells.first <= column && column < cells.end)
                            << every << ": " << x << ' ' << y;
                    }
                }
                word += 2 * std::size_t{InterleavedPlan::bands(heights[grid])};
                const frame::GridCounts& counts = plan.grids[grid].counts;
                EXPECT_EQ(counts.planned,
                          counts.shaded + counts.off_screen + counts.covered + counts.hidden);
            }
            EXPECT_EQ(word, plan.table.size());
        }
    }
}

}  // namespace
}  // namespace gazeloop::foveation
