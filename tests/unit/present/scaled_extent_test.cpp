#include "runtime/present/scaled_extent.h"

#include <gtest/gtest.h>

#include <limits>

namespace gazeloop::present {
namespace {

constexpr vk::Extent2D kMost(16384, 16384);

TEST(ScaledExtent, IsTheNearestWholeOne) {
    EXPECT_EQ(scaled_extent({1280, 1441}, 0.5, kMost), vk::Extent2D(640, 721));
    EXPECT_EQ(scaled_extent({1280, 1440}, 1.0, kMost), vk::Extent2D(1280, 1440));
}

TEST(ScaledExtent, HasTwoPixelsAtLeast) {
    EXPECT_EQ(scaled_extent({1280, 1440}, 1e-9, kMost), vk::Extent2D(2, 2));
    EXPECT_EQ(scaled_extent({0, 1}, 1.0, kMost), vk::Extent2D(2, 2));
}

TEST(ScaledExtent, NeverExceedsTheMost) {
    EXPECT_EQ(scaled_extent({1280, 1440}, 1e300, kMost), kMost);
    EXPECT_EQ(scaled_extent({1280, 1440}, std::numeric_limits<double>::infinity(), kMost), kMost);
    EXPECT_EQ(scaled_extent({1280, 1440}, 1.0, {1280, 1000}), vk::Extent2D(1280, 1000));
    EXPECT_EQ(scaled_extent({1280, 1440}, 1.0, {1, 0}), vk::Extent2D(1, 0));
}

}  // namespace
}  // namespace gazeloop::present
