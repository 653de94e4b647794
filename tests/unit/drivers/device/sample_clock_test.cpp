#include "drivers/device/sample_clock.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cstdint>
#include <functional>
#include <string>
#include <vector>

#include "sim/random.h"

namespace gazeloop::drivers {
namespace {

using testing::HasSubstr;

constexpr double kRate_hz = 120.0;
constexpr double kMicrosecond_ns = 1000.0;

/// What is told in a minute of a tracker that stamps its samples so (microseconds).
std::vector<std::string> told_of(const std::function<double(int sample, double second)>& stamp_us) {
    SampleClock clock({64, kMicrosecond_ns}, {});
    sim::Random random(3, sim::Stream::Jitter);
    std::vector<std::string> told;
    double arrived_ns = 0.0;
    for (int i = 0; i < static_cast<int>(60.0 * kRate_hz); ++i) {
        const double second = i / kRate_hz;
        arrived_ns = std::max(arrived_ns, second * 1e9 + 5e12 + random.exponential(300e3));
        gaze::GazeSample sample;
        clock.stamp(static_cast<std::uint64_t>(stamp_us(i, second)),
                    static_cast<std::int64_t>(arrived_ns), sample);
        if (auto change = clock.take_change()) {
            told.push_back(std::move(*change));
        }
    }
    return told;
}

TEST(SampleClock, TellsThatAnHonestClockIsGoodAndNoMore) {
    const auto told = told_of([](int, double second) { return second * 1e6; });
    ASSERT_EQ(told.size(), 1U);
    EXPECT_THAT(told.front(), HasSubstr("clock: good"));
}

// A step of a clock that is set all the time is no news, but that it is of no use is.
TEST(SampleClock, TellsLiesOnce) {
    sim::Random random(9, sim::Stream::Noise);
    const auto backwards = [](int, double second) { return 1e9 - second * 1e6; };
    const auto at_random = [&](int, double) { return random.uniform(0.0, 1e9); };
    const auto constant = [](int, double) { return 42.0; };
    const auto whole_seconds = [](int, double second) { return std::floor(second) * 1e6; };
    const auto counts_seconds = [](int, double second) { return std::floor(second); };
    const auto twice_as_fast = [](int, double second) { return second * 2e6; };
    const auto two_clocks = [](int sample, double second) {
        return second * 1e6 + (sample % 2 == 0 ? 5e8 : 0.0);
    };
    const auto set_each_second = [](int, double second) {
        return second * 1e6 + std::floor(second) * 1e5;
    };
    const std::vector<std::function<double(int, double)>> lies{
        backwards,      at_random,     constant,   whole_seconds,
        counts_seconds, twice_as_fast, two_clocks, set_each_second};
    for (std::size_t lie = 0; lie < lies.size(); ++lie) {
        const auto told = told_of(lies[lie]);
        EXPECT_LE(told.size(), 3U) << lie;
        ASSERT_FALSE(told.empty()) << lie;
        EXPECT_THAT(told.back(), HasSubstr("unusable")) << lie;
        EXPECT_EQ(std::ranges::count_if(told,
                                        [](const std::string& line) {
                                            return line.find("unusable") != std::string::npos;
                                        }),
                  1)
            << lie;
    }
}

// A run may be over before the calm after another line is.
TEST(SampleClock, TellsAtOnceThatTheAgeIsUnknown) {
    const auto stands_still_after_2_s =
        told_of([](int, double second) { return std::min(second, 2.0) * 1e6; });
    ASSERT_EQ(stands_still_after_2_s.size(), 2U);
    EXPECT_THAT(stands_still_after_2_s[0], HasSubstr("good"));
    EXPECT_THAT(stands_still_after_2_s[1], HasSubstr("unusable (timestamps stand still)"));
    SampleClock clock({64, kMicrosecond_ns}, {});
    int told = 0;
    for (int i = 0; i < static_cast<int>(4.0 * kRate_hz); ++i) {
        gaze::GazeSample sample;
        const double second = i / kRate_hz;
        clock.stamp(static_cast<std::uint64_t>(std::min(second, 2.0) * 1e6),
                    static_cast<std::int64_t>(second * 1e9 + 5e12), sample);
        told += clock.take_change() ? 1 : 0;
    }
    EXPECT_EQ(told, 2) << "within the calm";
}

// One sample whose time is unknown is no change of what the clock is worth.
TEST(SampleClock, TellsNothingOfOneRepeatedTimestamp) {
    const auto told = told_of([](int sample, double second) {
        return (sample == 3000 ? second - 1.0 / kRate_hz : second) * 1e6;
    });
    EXPECT_EQ(told.size(), 1U);
}

TEST(SampleClock, TellsStepsButNoFloodOfThem) {
    const auto once =
        told_of([](int, double second) { return second * 1e6 + (second > 20.0 ? 5e6 : 0.0); });
    ASSERT_EQ(once.size(), 2U);
    EXPECT_EQ(once.back(), "clock: the tracker's clock was set");
    const auto each_5_s =
        told_of([](int, double second) { return second * 1e6 + std::floor(second / 5.0) * 1e5; });
    EXPECT_GE(each_5_s.size(), 2U);
    EXPECT_LE(each_5_s.size(), 60'000'000'000 / SampleClock::kCalm_ns + 1);
}

TEST(SampleClock, CountsThePollingInItsUncertainty) {
    gaze::GazeSample sample;
    SampleClock clock({64, kMicrosecond_ns},
                      {.least_ns = 1'000'000, .uncertainty_ns = 2'000, .polling_ns = 4'000'000});
    for (int i = 0; i < 1000; ++i) {
        clock.stamp(static_cast<std::uint64_t>(i) * 8'333, std::int64_t{i} * 8'333'000, sample);
    }
    ASSERT_TRUE(sample.uncertainty_ns.has_value());
    EXPECT_GE(*sample.uncertainty_ns, 4'002'000);
    EXPECT_EQ(sample.ready.ns - sample.sampled.ns, 1'000'000);
}

}  // namespace
}  // namespace gazeloop::drivers
