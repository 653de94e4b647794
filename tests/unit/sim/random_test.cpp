#include "sim/random.h"

#include <gtest/gtest.h>

#include <limits>

namespace gazeloop::sim {
namespace {

TEST(Random, GivesTheSameNumbersEverywhere) {
    // Worked out by another implementation of SplitMix64.
    Random random(1, Stream::Sway);
    EXPECT_EQ(random.uniform(), 0x1.7d45f07268e97p-1);
    EXPECT_EQ(random.uniform(), 0x1.2b6f17940e53ap-2);
    EXPECT_EQ(random.uniform(), 0x1.738e5fc66355cp-3);
    Random other(std::numeric_limits<std::uint64_t>::max(), Stream::Noise, 7);
    EXPECT_EQ(other.uniform(), 0x1.191e925e14410p-2);
    EXPECT_EQ(other.uniform(), 0x1.0de003f488d42p-2);
}

TEST(Random, HasStreamsAndEventsOfTheirOwn) {
    const double first = Random(1, Stream::Sway).uniform();
    EXPECT_NE(Random(1, Stream::Targets).uniform(), first);
    EXPECT_NE(Random(1, Stream::Sway, 1).uniform(), first);
    EXPECT_NE(Random(2, Stream::Sway).uniform(), first);
    // Neighbouring events are not the same sequence, shifted.
    Random one(1, Stream::Sway, 0);
    (void)one.uniform();
    EXPECT_NE(Random(1, Stream::Sway, 1).uniform(), one.uniform());
}

TEST(Random, HasTheDistributionsItSays) {
    // Bounds are five standard errors of the estimates.
    Random random(42, Stream::Targets);
    constexpr int kDraws = 200'000;
    double sum = 0.0;
    double squares = 0.0;
    double uniforms = 0.0;
    double exponentials = 0.0;
    int below_median = 0;
    for (int i = 0; i < kDraws; ++i) {
        const double normal = random.normal();
        sum += normal;
        squares += normal * normal;
        const double uniform = random.uniform(2.0, 4.0);
        EXPECT_TRUE(uniform >= 2.0 && uniform < 4.0);
        uniforms += uniform;
        exponentials += random.exponential(3.0);
        below_median += random.log_normal(0.224, 0.45) < 0.224 ? 1 : 0;
    }
    EXPECT_NEAR(sum / kDraws, 0.0, 0.0112);
    EXPECT_NEAR(squares / kDraws, 1.0, 0.0159);
    EXPECT_NEAR(uniforms / kDraws, 3.0, 0.0065);
    EXPECT_NEAR(exponentials / kDraws, 3.0, 0.034);
    EXPECT_NEAR(static_cast<double>(below_median) / kDraws, 0.5, 0.0056);
}

}  // namespace
}  // namespace gazeloop::sim
