#include "runtime/time/tick_counter.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

namespace gazeloop::time {
namespace {

TEST(TickCounter, GoesOnThroughTheWrap) {
    TickCounter counter(32, 1000.0);
    EXPECT_EQ(counter.to_ns(0xFFFFFFF0U), 0xFFFFFFF0LL * 1000);
    EXPECT_EQ(counter.to_ns(0xFFFFFFFFU), 0xFFFFFFFFLL * 1000);
    EXPECT_EQ(counter.to_ns(4), (0x100000000LL + 4) * 1000);
    EXPECT_EQ(counter.to_ns(1), (0x100000000LL + 1) * 1000) << "a little back is back";
}

// GPUs count with 36 to 64 bits.
TEST(TickCounter, DifferencesGoTheShorterWayRound) {
    constexpr std::uint64_t kLast36 = (1ULL << 36) - 1;
    EXPECT_EQ(tick_difference(kLast36 - 4, 5, 36), 10);
    EXPECT_EQ(tick_difference(5, kLast36 - 4, 36), -10);
    EXPECT_EQ(tick_difference(0, 1ULL << 35, 36), -(1LL << 35));
    EXPECT_EQ(tick_difference(7, (1ULL << 60) + 9, 36), 2) << "bits above hold anything";
    EXPECT_EQ(tick_difference(~0ULL, 0, 64), 1);
    EXPECT_EQ(tick_difference(3, 3, 1), 0);
    EXPECT_EQ(tick_difference(0, 1, 1), -1);
}

TEST(TickCounter, AWideCounterNeedsNoUnwrapping) {
    TickCounter counter(64, 1000.0);
    EXPECT_EQ(counter.to_ns(5), 5000);
    EXPECT_EQ(counter.to_ns(1'000'000'000'000), 1'000'000'000'000'000);
    EXPECT_EQ(counter.to_ns(0), 0);
}

TEST(TickCounter, SaturatesAndRounds) {
    EXPECT_EQ(TickCounter(64, 1e200).to_ns(1), std::numeric_limits<std::int64_t>::max());
    EXPECT_EQ(TickCounter(64, 1e200).to_ns(0), 0);
    EXPECT_EQ(TickCounter(32, 0.4).to_ns(3), 1);
    EXPECT_EQ(TickCounter(8, 1e6 / 3.0).to_ns(3), 1'000'000);
}

// Windows' clocks count from 1601, which is more nanoseconds ago than 63 bits hold.
TEST(TickCounter, CountsFromTheFirstReadingWhereThatIsFarFromZero) {
    TickCounter microseconds(64, 1000.0);
    EXPECT_EQ(microseconds.to_ns(13'340'000'000'000'000), 0);
    EXPECT_EQ(microseconds.to_ns(13'340'000'000'008'333), 8'333'000);
    TickCounter file_time(64, 100.0);
    EXPECT_EQ(file_time.to_ns(133'400'000'000'000'000), 0);
    EXPECT_EQ(file_time.to_ns(133'400'000'000'083'333), 8'333'300);
    // Not whole nanoseconds: exact as long as double is.
    TickCounter fraction(64, 0.5);
    EXPECT_EQ(fraction.to_ns(std::uint64_t{1} << 60U), 0);
    EXPECT_EQ(fraction.to_ns((std::uint64_t{1} << 60U) + 8), 4);
    // Unix time in nanoseconds is not that far.
    EXPECT_EQ(TickCounter(64, 1.0).to_ns(1'763'870'000'000'000'000), 1'763'870'000'000'000'000);
}

TEST(TickCounter, ComesBackFromReadingsThatCannotBe) {
    for (const std::uint64_t absurd : {std::uint64_t{1} << 63U, (std::uint64_t{1} << 63U) - 1}) {
        TickCounter counter(64, 1000.0);
        EXPECT_EQ(counter.to_ns(absurd), 0);
        const std::int64_t first_ns = counter.to_ns(1'000'000);
        EXPECT_EQ(counter.to_ns(1'008'333) - first_ns, 8'333'000);
    }
}

RC_GTEST_PROP(TickCounter, FollowsAnyCounterThatAdvancesByLessThanHalfItsRange, ()) {
    const auto bits = *rc::gen::inRange<std::uint32_t>(2, 65);
    const std::uint64_t mask = bits == 64 ? ~std::uint64_t{0} : (std::uint64_t{1} << bits) - 1;
    const auto steps =
        *rc::gen::container<std::vector<std::uint32_t>>(rc::gen::arbitrary<std::uint32_t>());
    std::uint64_t truth = *rc::gen::arbitrary<std::uint16_t>() & mask;
    TickCounter counter(bits, 1.0);
    RC_ASSERT(counter.to_ns(truth) == static_cast<std::int64_t>(truth));
    for (const std::uint32_t step : steps) {
        truth += step & (mask >> 1U);
        RC_ASSERT(counter.to_ns(truth & mask) == static_cast<std::int64_t>(truth));
    }
}

}  // namespace
}  // namespace gazeloop::time
