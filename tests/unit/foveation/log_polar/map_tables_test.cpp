#include "runtime/foveation/log_polar/map_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <vector>

#include "tests/unit/foveation/log_polar/every_kernel.h"

namespace gazeloop::foveation {
namespace {

constexpr gaze::EyeView kView{.fov = {-0.9, 0.8, 0.85, -0.85}, .width_px = 800, .height_px = 900};

TEST(MapTables, HoldTheFunctionsTheyReplace) {
    const MapTables tables = build_map_tables(RadialKernel(4.0), {100, 60});
    EXPECT_EQ(tables.log2_mantissa.front(), 0.0F);
    EXPECT_EQ(tables.log2_mantissa.back(), 1.0F);
    EXPECT_EQ(tables.exp2_fraction.front(), 1.0F);
    EXPECT_EQ(tables.exp2_fraction.back(), 2.0F);
    EXPECT_EQ(tables.forward.front(), 1.0F);
    EXPECT_EQ(tables.forward.back(), 0.0F);
    // Half way is a quarter of the way in from the far end: K(3/4).
    EXPECT_FLOAT_EQ(tables.forward[MapTables::kForwardSteps / 2], 0.31640625F);
    ASSERT_EQ(tables.column.size(), 201U);
    EXPECT_EQ(tables.column.front(), 1.0F);
    EXPECT_EQ(tables.column.back(), 0.0F);
    EXPECT_FLOAT_EQ(tables.column[1], static_cast<float>(1.0 - std::pow(0.5 / 100, 0.25)));
    ASSERT_EQ(tables.row.size(), 60U);
    EXPECT_FLOAT_EQ(tables.row[0].cosine, static_cast<float>(std::cos(std::numbers::pi / 60)));
    EXPECT_FLOAT_EQ(tables.row[0].sine, static_cast<float>(std::sin(std::numbers::pi / 60)));
}

TEST(MapTables, HoldTheAcuityProfile) {
    const AcuityProfile profile = value_or_throw(AcuityProfile::create({}, kView));
    const MapTables tables = build_map_tables(profile);
    EXPECT_EQ(tables.forward.front(), 1.0F);
    EXPECT_LT(tables.forward.back(), 1e-3F / static_cast<float>(profile.lp().width));
    ASSERT_EQ(tables.column.size(), 2 * std::size_t{profile.lp().width} + 1);
    EXPECT_EQ(tables.column.front(), 0.0F);
    EXPECT_FLOAT_EQ(tables.column.back(), 114.58865F);
}

TEST(MapTables, AreMonotoneForEveryMap) {
    std::vector<MapTables> maps{build_map_tables(value_or_throw(AcuityProfile::create({}, kView)))};
    for (const RadialKernel& kernel : every_kernel()) {
        maps.push_back(build_map_tables(kernel, {300, 4}));
    }
    for (const MapTables& tables : maps) {
        for (std::size_t i = 1; i < tables.forward.size(); ++i) {
            ASSERT_LE(tables.forward[i], tables.forward[i - 1]) << i;
        }
        const bool rises = tables.column.back() > tables.column.front();
        for (std::size_t i = 1; i < tables.column.size(); ++i) {
            const float step = tables.column[i] - tables.column[i - 1];
            ASSERT_GE(rises ? step : -step, 0.0F) << i;
        }
    }
}

}  // namespace
}  // namespace gazeloop::foveation
