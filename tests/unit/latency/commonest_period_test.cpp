#include "runtime/latency/commonest_period.h"

#include <gtest/gtest.h>

namespace gazeloop::latency {
namespace {

constexpr std::int64_t k90Hz = 11'111'111;
constexpr std::int64_t k72Hz = 13'888'888;

TEST(CommonestPeriod, IsNoneBeforeTheFirst) { EXPECT_EQ(CommonestPeriod().ns(), std::nullopt); }

TEST(CommonestPeriod, LetsNoOddOneDecide) {
    CommonestPeriod period;
    period.add(16'000'000);  // as a compositor says before it has measured
    EXPECT_EQ(period.ns(), 16'000'000);
    for (int i = 0; i < 10; ++i) {
        period.add(k90Hz);
    }
    period.add(500'000'000);
    EXPECT_EQ(period.ns(), k90Hz);
}

TEST(CommonestPeriod, TakesWhatIsWithinAPercentAsOne) {
    CommonestPeriod period;
    for (std::int64_t i = 0; i < 10; ++i) {
        period.add(k90Hz + i % 2 * 50'000);
        period.add(k72Hz + i * 1'000'000);
    }
    EXPECT_EQ(period.ns(), k90Hz + 50'000) << "as last announced";
}

TEST(CommonestPeriod, IsTheLaterOfTwoAsCommon) {
    CommonestPeriod period;
    period.add(k90Hz);
    period.add(k72Hz);
    EXPECT_EQ(period.ns(), k72Hz);
    period.add(k90Hz);
    period.add(k72Hz);
    period.add(k90Hz);
    EXPECT_EQ(period.ns(), k90Hz);
}

// More kinds than are counted apart: the common one is among them all the same.
TEST(CommonestPeriod, IsFoundAmongMany) {
    CommonestPeriod period;
    for (std::int64_t i = 0; i < 300; ++i) {
        period.add(20'000'000 + i * 1'000'000);
        if (i % 2 == 0) {
            period.add(k90Hz);
        }
    }
    EXPECT_EQ(period.ns(), k90Hz);
}

}  // namespace
}  // namespace gazeloop::latency
