#include "runtime/foveation/map_tables.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace gazeloop::foveation {
namespace {

TEST(MapTables, HoldTheFunctionsTheyReplace) {
    const MapTables tables = build_map_tables({4.0}, {100, 60});
    EXPECT_EQ(tables.log2_mantissa.front(), 0.0F);
    EXPECT_EQ(tables.log2_mantissa.back(), 1.0F);
    EXPECT_EQ(tables.exp2_fraction.front(), 1.0F);
    EXPECT_EQ(tables.exp2_fraction.back(), 2.0F);
    EXPECT_EQ(tables.kernel.front(), 0.0F);
    EXPECT_EQ(tables.kernel.back(), 1.0F);
    EXPECT_FLOAT_EQ(tables.kernel[MapTables::kKernelSteps / 2], 0.0625F);
    ASSERT_EQ(tables.column.size(), 201U);
    EXPECT_EQ(tables.column.front(), 0.0F);
    EXPECT_EQ(tables.column.back(), 1.0F);
    EXPECT_FLOAT_EQ(tables.column[1], static_cast<float>(std::pow(0.5 / 100, 0.25)));
    ASSERT_EQ(tables.row.size(), 60U);
    EXPECT_FLOAT_EQ(tables.row[0].cosine, static_cast<float>(std::cos(std::numbers::pi / 60)));
    EXPECT_FLOAT_EQ(tables.row[0].sine, static_cast<float>(std::sin(std::numbers::pi / 60)));
}

TEST(MapTables, RiseAndStayFiniteForEveryKernel) {
    for (const double alpha : {PowerKernel::kMinAlpha, 1.0, 4.0, PowerKernel::kMaxAlpha}) {
        const MapTables tables = build_map_tables({alpha}, {2, 4});
        for (std::size_t i = 1; i < tables.kernel.size(); ++i) {
            ASSERT_GE(tables.kernel[i], tables.kernel[i - 1]) << alpha << ' ' << i;
        }
        for (std::size_t i = 1; i < tables.column.size(); ++i) {
            ASSERT_GT(tables.column[i], tables.column[i - 1]) << alpha << ' ' << i;
        }
    }
}

}  // namespace
}  // namespace gazeloop::foveation
