#include "runtime/foveation/plans/interleaved_plan.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <numbers>
#include <set>
#include <span>

#include "runtime/foveation/plans/kfr_plan.h"
#include "tests/unit/foveation/picture/masks.h"

namespace gazeloop::foveation {
namespace {

bool nothing_of(std::span<const std::uint32_t> bands) {
    for (std::size_t word = 0; word < bands.size(); word += 2) {
        if (bands[word] < bands[word + 1]) {
            return false;
        }
    }
    return true;
}

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
            FrameInRun frame;
            frame.before[0] = {view, fovea.position};
            method.plan(gaze::Eye::Left, view, fovea, &hidden, frame, plan);
            EXPECT_TRUE(nothing_of(method.bands_of(plan, gaze::Eye::Left, kSide).texel_refill));
            EXPECT_TRUE(nothing_of(method.bands_of(plan, gaze::Eye::Left, kSide).pixel_refill));
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
            const InterleavedPlan::Bands bands = method.bands_of(plan, gaze::Eye::Left, kSide);
            EXPECT_EQ(word, bands.texels.size() + bands.pixels.size());
            EXPECT_EQ(plan.table.size(),
                      word + bands.texel_refill.size() + bands.pixel_refill.size());
        }
    }
}

/// Both grids' blocks that are shaded whole.
class Refill : public testing::Test {
  protected:
    static constexpr std::uint32_t kSide = 400;
    static constexpr std::uint32_t kEvery = 4;

    Refill() { EXPECT_TRUE(method_.prepare({view_, view_})); }

    static gaze::FoveaPoint looking(double x_px, double y_px) {
        gaze::FoveaPoint fovea;
        fovea.position = {x_px, y_px};
        return fovea;
    }
    InterleavedPlan::Bands planned(const gaze::FoveaPoint& fovea, const FrameInRun& frame) {
        method_.plan(gaze::Eye::Left, view_, fovea, nullptr, frame, plan_);
        return method_.bands_of(plan_, gaze::Eye::Left, kSide);
    }
    static FrameInRun after(const gaze::EyeView& view, const gaze::FoveaPoint& fovea) {
        FrameInRun frame{.index = 7, .follows = true};
        frame.before[0] = {view, fovea.position};
        return frame;
    }
    std::uint64_t samples() const {
        return plan_.grids[0].counts.shaded + plan_.grids[1].counts.shaded;
    }

    const gaze::EyeView view_ = tests::square_view(kSide, kSide);
    InterleavedPlan method_{std::make_unique<KfrPlan>(KfrParameters{.aspect = 0.35}),
                            CellTurns{kEvery}, CellTurns{kEvery}};
    EyePlan plan_;
};

TEST_F(Refill, IsOfEverythingWhereNoFrameCameBefore) {
    const gaze::FoveaPoint fovea = looking(180, 200);
    planned(fovea, after(view_, fovea));
    const std::uint64_t one_turn = samples();
    const InterleavedPlan::Bands bands = planned(fovea, {});
    EXPECT_EQ(samples(), kEvery * one_turn);
    for (std::size_t grid = 0; grid < 2; ++grid) {
        const auto& cells = plan_.grids[grid].bands;
        const auto whole = grid == 0 ? bands.texel_refill : bands.pixel_refill;
        for (std::size_t band = 0; band < cells.size(); ++band) {
            EXPECT_EQ(whole[2 * band], cells[band].first) << grid << ": " << band;
            EXPECT_EQ(whole[2 * band + 1], cells[band].end) << grid << ": " << band;
        }
    }
}

TEST_F(Refill, IsOfNothingWhereNobodyAsks) {
    InterleavedPlan method(std::make_unique<KfrPlan>(KfrParameters{.aspect = 0.35}),
                           CellTurns{kEvery}, CellTurns{kEvery}, false);
    ASSERT_TRUE(method.prepare({view_, view_}));
    EyePlan plan;
    method.plan(gaze::Eye::Left, view_, looking(180, 200), nullptr, {}, plan);
    const InterleavedPlan::Bands bands = method.bands_of(plan, gaze::Eye::Left, kSide);
    EXPECT_TRUE(nothing_of(bands.texel_refill) && nothing_of(bands.pixel_refill));
}

// Every pixel of the disc that was outside of it is shaded; a small step asks for little.
TEST_F(Refill, IsOfWhatWasOutsideTheDisc) {
    for (const double step : {4.0, 12.0, 150.0}) {
        const gaze::FoveaPoint was = looking(180, 200);
        const gaze::FoveaPoint now = looking(180 + 0.8 * step, 200 - 0.6 * step);
        const InterleavedPlan::Bands bands = planned(now, after(view_, was));
        const double radius = plan_.ring_px;
        const CellTurns turns{kEvery};
        std::uint64_t refilled = 0;
        for (std::uint32_t y = 0; y < kSide; ++y) {
            const std::size_t word = 2 * std::size_t{y / turns.block_height() / kBandRows};
            for (std::uint32_t x = 0; x < kSide; ++x) {
                const auto inside = [&](const gaze::FoveaPoint& fovea, double within) {
                    return std::hypot(x + 0.5 - fovea.position.x_px,
                                      y + 0.5 - fovea.position.y_px) < within;
                };
                const std::uint32_t column = x / turns.block_width();
                const bool whole =
                    bands.pixel_refill[word] <= column && column < bands.pixel_refill[word + 1];
                refilled += whole ? 1 : 0;
                ASSERT_TRUE(whole || !inside(now, radius) || inside(was, radius))
                    << step << ": " << x << ' ' << y;
            }
        }
        const double disc = std::numbers::pi * radius * radius;
        if (step < 0.2 * radius) {
            EXPECT_LT(static_cast<double>(refilled), 0.75 * disc) << step;
        }
    }
}

// The gaze that stays on what it looks at as the head turns has not moved.
TEST_F(Refill, IsOfNothingWhereTheHeadTurnsUnderTheGaze) {
    gaze::EyeView turned = view_;
    turned.pose.orientation = glm::angleAxis(0.05, glm::dvec3(0, 1, 0));
    const gaze::FoveaPoint was = looking(180, 200);
    const glm::dvec3 there = gaze::unproject(was.position, turned);
    gaze::FoveaPoint now;
    now.position = gaze::project(turned.pose.orientation * there, view_);
    const InterleavedPlan::Bands bands = planned(now, after(turned, was));
    EXPECT_TRUE(nothing_of(bands.texel_refill) && nothing_of(bands.pixel_refill));
    EXPECT_GT(
        std::hypot(now.position.x_px - was.position.x_px, now.position.y_px - was.position.y_px),
        5.0);
}

}  // namespace
}  // namespace gazeloop::foveation
