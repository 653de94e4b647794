#include "runtime/present/openxr/announced_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace gazeloop::present {
namespace {

using ::testing::HasSubstr;
using ::testing::Optional;

constexpr std::int64_t kMs = 1'000'000;

TEST(AnnouncedTime, IsNotOddWhileItGrows) {
    AnnouncedTime announced;
    for (std::int64_t frame = 1; frame < 100; ++frame) {
        EXPECT_EQ(announced.next(frame * 14 * kMs, (frame - 2) * 14 * kMs), std::nullopt);
    }
}

TEST(AnnouncedTime, IsOddWhereItGoesBackOrStands) {
    AnnouncedTime announced;
    EXPECT_EQ(announced.next(100 * kMs, 90 * kMs), std::nullopt);
    EXPECT_THAT(announced.next(97 * kMs, 95 * kMs), Optional(HasSubstr("went back by 3.000 ms")));
    EXPECT_THAT(announced.next(97 * kMs, 95 * kMs), Optional(HasSubstr("went back by 0.000 ms")));
}

TEST(AnnouncedTime, IsOddOnceWhileItIsFar) {
    AnnouncedTime announced;
    EXPECT_THAT(announced.next(20'000 * kMs, 0), Optional(HasSubstr("lies 20.000 s ahead")));
    EXPECT_EQ(announced.next(20'014 * kMs, 14 * kMs), std::nullopt);
    EXPECT_EQ(announced.next(20'028 * kMs, 20'020 * kMs), std::nullopt);
    EXPECT_THAT(announced.next(20'042 * kMs, 60'042 * kMs), Optional(HasSubstr("40.000 s back")));
}

TEST(AnnouncedTime, StandsAnyTime) {
    constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    AnnouncedTime announced;
    EXPECT_TRUE(announced.next(kMost, kLeast).has_value());
    EXPECT_TRUE(announced.next(kLeast, kMost).has_value());
    EXPECT_FALSE(announced.next(0, 0).has_value());
}

}  // namespace
}  // namespace gazeloop::present
