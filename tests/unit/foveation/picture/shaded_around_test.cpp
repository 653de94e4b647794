#include "runtime/foveation/picture/shaded_around.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/foveation/plans/kfr_plan.h"

namespace gazeloop::foveation {
namespace {

constexpr ImageSize kImage{200, 160};

std::vector<Columns> disc_of(const gaze::PixelPosition& fovea, ImageSize image = kImage) {
    const KfrParameters parameters;
    LogPolarPlan plan;
    plan_kfr(parameters, value_or_throw(lp_buffer_size(parameters, image)), image, fovea, plan);
    return plan.disc.bands;
}

bool operator==(const Tile& a, const Tile& b) {
    return a.x0 == b.x0 && a.y0 == b.y0 && a.x1 == b.x1 && a.y1 == b.y1;
}

TEST(ShadedAround, IsAsLargeAsAskedWhereThereIsRoom) {
    EXPECT_TRUE(shaded_around({100.5, 80.5}, 6, 3, kImage, disc_of({100.5, 80.5})) ==
                (Tile{94, 77, 107, 84}));
    EXPECT_TRUE(shaded_around({100.5, 80.5}, 0, 0, kImage, disc_of({100.5, 80.5})) ==
                (Tile{100, 80, 101, 81}));
}

TEST(ShadedAround, EndsAtThePicturesEdges) {
    EXPECT_TRUE(shaded_around({0.0, 159.9}, 3, 2, kImage, disc_of({0.0, 159.9})) ==
                (Tile{0, 157, 4, 160}));
}

TEST(ShadedAround, IsEmptyWhereNothingIsShaded) {
    const std::vector<Columns> disc = disc_of({100.0, 80.0});
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    for (const gaze::PixelPosition& place : {gaze::PixelPosition{10, 10},
                                             {-1, 80},
                                             {200, 80},
                                             {100, 160},
                                             {kNan, 80},
                                             {100, kNan},
                                             {kInfinity, 80},
                                             {100, -kInfinity}}) {
        EXPECT_EQ(shaded_around(place, 10, 10, kImage, disc).area(), 0U);
    }
    EXPECT_EQ(shaded_around({100, 80}, 10, 10, kImage, {}).area(), 0U);
}

// Whatever plan, place and reach: every pixel is shaded, the place is among them, and there are no
// more than asked for.
RC_GTEST_PROP(ShadedAroundProperty, HoldsOnlyWhatIsShaded, ()) {
    const ImageSize image{*rc::gen::inRange(16U, 400U), *rc::gen::inRange(16U, 400U)};
    const gaze::PixelPosition fovea{*rc::gen::inRange(-100, 500) + 0.25,
                                    *rc::gen::inRange(-100, 500) + 0.5};
    const auto reach_x = *rc::gen::inRange(0U, 600U);
    const auto reach_y = *rc::gen::inRange(0U, 600U);
    const std::vector<Columns> bands = disc_of(fovea, image);
    const Tile tile = shaded_around(fovea, reach_x, reach_y, image, bands);
    const bool on_screen = fovea.x_px >= 0 && fovea.x_px < image.width_px && fovea.y_px >= 0 &&
                           fovea.y_px < image.height_px;
    RC_ASSERT(on_screen || tile.area() == 0);
    if (tile.area() == 0) {
        return;
    }
    const auto x = static_cast<std::uint32_t>(fovea.x_px);
    const auto y = static_cast<std::uint32_t>(fovea.y_px);
    RC_ASSERT(tile.x0 <= x && x < tile.x1 && tile.y0 <= y && y < tile.y1);
    RC_ASSERT(tile.x1 <= image.width_px && tile.y1 <= image.height_px);
    RC_ASSERT(x - tile.x0 <= reach_x && tile.x1 - 1 - x <= reach_x);
    RC_ASSERT(y - tile.y0 <= reach_y && tile.y1 - 1 - y <= reach_y);
    for (std::uint32_t row = tile.y0; row < tile.y1; ++row) {
        const Columns& band = bands[row / kBandRows];
        RC_ASSERT(band.first <= tile.x0 && tile.x1 <= band.end);
    }
}

}  // namespace
}  // namespace gazeloop::foveation
