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

TEST(TickCounter, WrapsAfterTheRangeThatIsStated) {
    const TickRange word = TickRange::of_bits(32);
    TickCounter narrow(TickRange::of_bits(31), word, 1000.0);
    EXPECT_EQ(narrow.to_ns(0x7FFFFFF0U), 0x7FFFFFF0LL * 1000);
    EXPECT_EQ(narrow.to_ns(4), 0x80000004LL * 1000);
    TickCounter decimal({.least = 0, .span = 999'999}, word, 1000.0);
    EXPECT_EQ(decimal.to_ns(999'998), 999'998'000);
    EXPECT_EQ(decimal.to_ns(3), 1'000'003'000);
    TickCounter from_one({.least = 1, .span = 99}, word, 1.0);
    EXPECT_EQ(from_one.to_ns(100), 100);
    EXPECT_EQ(from_one.to_ns(1), 101) << "0 is no number of it";
    TickCounter with_sign(TickRange::of_signed_bits(16), TickRange::of_signed_bits(16), 1.0);
    EXPECT_EQ(with_sign.to_ns(static_cast<std::uint64_t>(-5)), -5);
    EXPECT_EQ(with_sign.to_ns(7), 7);
    EXPECT_EQ(with_sign.to_ns(20'007), 20'007);
    EXPECT_EQ(with_sign.to_ns(32'767), 32'767);
    EXPECT_EQ(with_sign.to_ns(static_cast<std::uint64_t>(-32'768)), 32'768);
}

// 2^31 - 1 is often written where a counter has 32 bits, and 255 may be left of another field.
TEST(TickCounter, IsAsWideAsWhatHoldsItOnceItGoesOnBeyondItsRange) {
    for (const TickRange& stated :
         {TickRange::of_bits(31), TickRange::of_bits(8), TickRange{.least = -500, .span = 1000}}) {
        const TickRange held =
            stated.least < 0 ? TickRange::of_signed_bits(32) : TickRange::of_bits(32);
        TickCounter counter(stated, held, 1.0);
        std::int64_t truth = 0x7FFFFE80;
        const std::int64_t offset = counter.to_ns(0x7FFFFE80U);
        for (int i = 0; i < 3000; ++i) {
            truth += 5'000'000;  // through two wraps
            const auto word = static_cast<std::uint32_t>(truth);
            const std::uint64_t ticks =
                stated.least < 0 ? static_cast<std::uint64_t>(static_cast<std::int32_t>(word))
                                 : word;
            ASSERT_EQ(counter.to_ns(ticks) - offset, truth - 0x7FFFFE80) << i;
        }
    }
}

TEST(TickCounter, IsNotMovedByALoneReadingBeyondItsRange) {
    TickCounter counter(TickRange::of_bits(31), TickRange::of_bits(32), 1.0);
    EXPECT_EQ(counter.to_ns(0x7FFFFFF0U), 0x7FFFFFF0LL);
    EXPECT_LT(counter.to_ns(0xFFFFFFFFU), 0x7FFFFFF0LL) << "backwards by far";
    EXPECT_EQ(counter.to_ns(16), 0x80000010LL) << "31 bits, through a wrap";
}

// A short counter wraps while nothing is read; another clock knows how often.
TEST(TickCounter, CountsWrapsThatNobodySawByTheTimeThatPassed) {
    TickCounter counter({.least = 0, .span = 999'999}, TickRange::of_bits(32), 1000.0);
    EXPECT_EQ(counter.to_ns(100'000), 100'000'000);
    EXPECT_EQ(counter.to_ns(800'000, 699'000'000), 800'000'000) << "more than half a range";
    EXPECT_EQ(counter.to_ns(300'000, 5'520'000'000), 6'300'000'000);
    EXPECT_EQ(counter.to_ns(290'000, 0), 6'290'000'000) << "set back a little";
    TickCounter wide(64, 1000.0);
    EXPECT_EQ(wide.to_ns(5), 5'000);
    EXPECT_EQ(wide.to_ns(7, std::numeric_limits<std::int64_t>::max()), 7'000);
    EXPECT_EQ(wide.to_ns(6, std::numeric_limits<std::int64_t>::min()), 6'000);
}

// GPUs count with 36 to 64 bits.
TEST(TickRange, DifferencesGoTheShorterWayRound) {
    constexpr auto kOf = TickRange::of_bits;
    constexpr std::uint64_t kLast36 = (1ULL << 36) - 1;
    EXPECT_EQ(tick_difference(kLast36 - 4, 5, kOf(36)), 10);
    EXPECT_EQ(tick_difference(5, kLast36 - 4, kOf(36)), -10);
    EXPECT_EQ(tick_difference(0, 1ULL << 35, kOf(36)), -(1LL << 35));
    EXPECT_EQ(tick_difference(7, (1ULL << 60) + 9, kOf(36)), 2) << "bits above hold anything";
    EXPECT_EQ(tick_difference(~0ULL, 0, kOf(64)), 1);
    EXPECT_EQ(tick_difference(0, 1ULL << 63, kOf(64)), std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(tick_difference(3, 3, kOf(1)), 0);
    EXPECT_EQ(tick_difference(0, 1, kOf(1)), -1);
    constexpr TickRange kSeven{.least = -3, .span = 6};
    EXPECT_EQ(tick_difference(3, static_cast<std::uint64_t>(-3), kSeven), 1);
    EXPECT_EQ(tick_difference(static_cast<std::uint64_t>(-3), 3, kSeven), -1);
    EXPECT_EQ(tick_difference(0, 3, kSeven), 3);
    EXPECT_EQ(tick_difference(0, 3, kSeven, 70), 73);
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

RC_GTEST_PROP(TickCounter, FollowsAnyRangeWhereTheTimeThatPassedIsKnownRoughly, ()) {
    const TickRange range{.least = *rc::gen::inRange<std::int64_t>(-1'000'000, 1'000'000),
                          .span = *rc::gen::inRange<std::uint64_t>(8, 1'000'000)};
    const auto steps =
        *rc::gen::container<std::vector<std::uint32_t>>(rc::gen::arbitrary<std::uint32_t>());
    const std::int64_t round = static_cast<std::int64_t>(range.span) + 1;
    TickCounter counter(
        range, range.least < 0 ? TickRange::of_signed_bits(32) : TickRange::of_bits(32), 1.0);
    std::int64_t truth = range.least;
    RC_ASSERT(counter.to_ns(static_cast<std::uint64_t>(truth)) == truth);
    for (const std::uint32_t step : steps) {
        truth += step;
        const std::int64_t shown = range.least + (truth - range.least) % round;
        const std::int64_t wrong = *rc::gen::inRange<std::int64_t>(-round / 2 + 1, round / 2);
        RC_ASSERT(counter.to_ns(static_cast<std::uint64_t>(shown), step + wrong) == truth);
    }
}

}  // namespace
}  // namespace gazeloop::time
