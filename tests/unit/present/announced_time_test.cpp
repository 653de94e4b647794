#include "runtime/present/openxr/announced_time.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>

namespace gazeloop::present {
namespace {

using ::testing::HasSubstr;

constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kDay = 86'400'000 * kMs;
constexpr std::int64_t kPeriod = 14 * kMs;
constexpr std::int64_t kLead = 2 * kPeriod;

/// A loop that wakes every 14 ms, two periods before what is announced.
class AnnouncedTimes : public testing::Test {
  protected:
    /// The next frame, its announced time moved by this.
    AnnouncedTime::Judgement next(std::int64_t moved_ns = 0) {
        now_ns_ += kPeriod;
        return announced_.next(now_ns_ + kLead + moved_ns, now_ns_ + kLead + moved_ns, now_ns_);
    }
    AnnouncedTime::Judgement next_without(std::int64_t announced) {
        now_ns_ += kPeriod;
        return announced_.next(announced, std::nullopt, now_ns_);
    }
    void expect_good(int frames) {
        for (int i = 0; i < frames; ++i) {
            const auto judged = next();
            EXPECT_TRUE(judged.good) << i;
            EXPECT_FALSE(judged.change.has_value()) << judged.change->text;
            EXPECT_EQ(judged.likely_ns, now_ns_ + kLead);
        }
    }
    static void expect_odd(const AnnouncedTime::Judgement& judged, const std::string& text) {
        EXPECT_FALSE(judged.good);
        ASSERT_TRUE(judged.change.has_value());
        EXPECT_EQ(judged.change->kind.name, frame::kDisplayTimeOddEvent.name);
        EXPECT_THAT(judged.change->text, HasSubstr(text));
    }
    static void expect_good_again(const AnnouncedTime::Judgement& judged, int odd) {
        EXPECT_TRUE(judged.good);
        ASSERT_TRUE(judged.change.has_value());
        EXPECT_EQ(judged.change->kind.name, frame::kDisplayTimeGoodEvent.name);
        EXPECT_THAT(judged.change->text, HasSubstr("again, " + std::to_string(odd) + " were not"));
    }

    AnnouncedTime announced_;
    std::int64_t now_ns_ = 100'000 * kMs;
};

TEST_F(AnnouncedTimes, AreGoodWhileTheyGrow) { expect_good(100); }

TEST_F(AnnouncedTimes, AreOddWhereThereIsNone) {
    expect_good(10);
    expect_odd(next_without(0), "is none (0)");
    for (int i = 1; i < 5; ++i) {
        const auto judged = next_without(0);
        EXPECT_FALSE(judged.good);
        EXPECT_FALSE(judged.change.has_value()) << "told once";
        EXPECT_EQ(judged.likely_ns, now_ns_ + kLead);
    }
    expect_good_again(next(), 5);
    expect_good(10);
    expect_odd(next_without(-5), "is none (-5)");
}

TEST_F(AnnouncedTimes, AreOddWhereTheyLieFarFromNow) {
    expect_good(10);
    expect_odd(next(27 * kDay), "s ahead");
    EXPECT_FALSE(next(27 * kDay).good);
    expect_good_again(next(), 2);
    expect_odd(next(-2000 * kMs), "lies 1.972 s back");
    const auto judged = next(-2000 * kMs);
    EXPECT_EQ(judged.likely_ns, now_ns_ + kLead);
    expect_good_again(next(), 2);
    expect_good(10);
}

TEST_F(AnnouncedTimes, AreOddWhileTheyAreBehindAGoodOne) {
    expect_good(10);
    expect_odd(next(-100 * kMs), "went back by 86.000 ms");
    for (int i = 1; i < 6; ++i) {
        EXPECT_FALSE(next(-100 * kMs).good) << "they lie before now";
    }
    expect_good_again(next(), 6);
    expect_odd(next(-kPeriod), "went back by 0.000 ms");
}

// One that was absurd itself, though not far off, does not spoil all those before it.
TEST_F(AnnouncedTimes, GoOnOnTheirLineAfterOneThatWasOff) {
    expect_good(10);
    EXPECT_TRUE(next(900 * kMs).good);
    expect_odd(next(), "went back");
    EXPECT_FALSE(next().good);
    expect_good_again(next(), 2);
    expect_good(10);
}

TEST_F(AnnouncedTimes, AreKnownFromTheFirstOddOneOn) {
    expect_odd(next_without(0), "is none");
    EXPECT_EQ(next_without(0).likely_ns, now_ns_);
    expect_good_again(next(), 2);
}

TEST(AnnouncedTime, StandsAnyTime) {
    constexpr std::int64_t kLeast = std::numeric_limits<std::int64_t>::min();
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    AnnouncedTime announced;
    EXPECT_FALSE(announced.next(kMost, kMost, kLeast).good);
    EXPECT_FALSE(announced.next(kLeast, kLeast, kMost).good);
    EXPECT_TRUE(announced.next(kMost, kMost, kMost).good);
    EXPECT_FALSE(announced.next(0, 0, kMost).good);
}

TEST(AnnouncedPeriod, IsUnknownWhereNoDisplayHasIt) {
    AnnouncedPeriod period;
    EXPECT_EQ(period.next(kPeriod).period_ns, kPeriod);
    EXPECT_FALSE(period.next(0).change.has_value()) << "says that it is not known";
    for (const std::int64_t odd :
         {std::int64_t{1}, -kPeriod, 1001 * kMs, std::numeric_limits<std::int64_t>::max()}) {
        const auto judged = period.next(odd);
        EXPECT_EQ(judged.period_ns, 0);
        ASSERT_TRUE(judged.change.has_value()) << odd;
        EXPECT_THAT(judged.change->text, HasSubstr(std::to_string(odd) + " ns"));
        EXPECT_FALSE(period.next(odd).change.has_value()) << "told once";
        EXPECT_EQ(period.next(kPeriod).period_ns, kPeriod);
    }
}

}  // namespace
}  // namespace gazeloop::present
