#include "runtime/time/timestamp_ticks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

#include "runtime/time/clock_fit.h"
#include "tests/unit/time/simulated_tracker.h"

namespace gazeloop::time {
namespace {

constexpr double kSeconds = 30.0;

/// One way in which samples can come.
struct Circumstances {
    Jitter jitter = Jitter::None;
    double jitter_ms = 0.0;
    double skew_ppm = 0.0;
    double lost_share = 0.0;

    [[nodiscard]] std::string text() const {
        return "jitter " + std::to_string(static_cast<int>(jitter)) + " of " +
               std::to_string(jitter_ms) + " ms, " + std::to_string(skew_ppm) + " ppm, lost " +
               std::to_string(lost_share);
    }
    [[nodiscard]] SimulatedTracker tracker(double rate_hz, std::int64_t tick_ns) const {
        return {.rate_hz = rate_hz,
                .skew_ppm = skew_ppm,
                .jitter = jitter,
                .jitter_ns = jitter_ms * kMs,
                .tick_ns = tick_ns,
                .lost_share = lost_share};
    }
};

std::vector<Circumstances> all_circumstances() {
    std::vector<Circumstances> all;
    for (const double skew_ppm : {-50.0, 0.0, 20.0, 50.0}) {
        for (const double lost_share : {0.0, 0.02, 0.2}) {
            all.push_back({Jitter::None, 0.0, skew_ppm, lost_share});
            for (const double jitter_ms : {0.1, 0.5, 1.0}) {
                all.push_back({Jitter::Uniform, jitter_ms, skew_ppm, lost_share});
                all.push_back({Jitter::Exponential, jitter_ms, skew_ppm, lost_share});
            }
        }
    }
    return all;
}

struct CoarseClock {
    double rate_hz;
    std::int64_t tick_ns;
};

class TickNearThePeriod : public testing::TestWithParam<CoarseClock> {};

TEST_P(TickNearThePeriod, IsNeverTakenForExactTimestamps) {
    for (const Circumstances& circumstances : all_circumstances()) {
        SCOPED_TRACE(circumstances.text());
        SimulatedTracker tracker = circumstances.tracker(GetParam().rate_hz, GetParam().tick_ns);
        ClockFit clock;
        const int samples = static_cast<int>(kSeconds * GetParam().rate_hz);
        int outside = 0;
        int wrongly_good = 0;
        int good_at_last = 0;
        for (int i = 0; i < samples; ++i) {
            const auto report = tracker.next();
            const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
            if (reading.verdict == ClockVerdict::Unusable) {
                continue;
            }
            const double error = std::abs(error_ns(reading, report));
            const bool good = reading.verdict == ClockVerdict::Good;
            outside += error > static_cast<double>(reading.uncertainty_ns) + 1.0 ? 1 : 0;
            wrongly_good += good && error > 1.0 * kMs ? 1 : 0;
            good_at_last += good && i > samples / 3 ? 1 : 0;
        }
        EXPECT_LT(outside, 0.01 * samples);
        EXPECT_LT(wrongly_good, 0.01 * samples);
        EXPECT_EQ(good_at_last, 0);
    }
}

// 1/64 s is Windows' tick, 10 and 4 ms are Linux' at 100 and 250 Hz.
INSTANTIATE_TEST_SUITE_P(
    Clocks, TickNearThePeriod,
    testing::Values(CoarseClock{60.0, 15'625'000}, CoarseClock{90.0, 10'000'000},
                    CoarseClock{120.0, 8'000'000}, CoarseClock{120.0, 5'000'000},
                    CoarseClock{200.0, 4'000'000}, CoarseClock{240.0, 4'000'000}));

class RegularTimestamps : public testing::TestWithParam<double> {};

// Of these rates all increments are multiples of the least one, to the nanosecond.
TEST_P(RegularTimestamps, StayGoodWhateverIsLost) {
    for (const Circumstances& circumstances : all_circumstances()) {
        SCOPED_TRACE(circumstances.text());
        SimulatedTracker tracker = circumstances.tracker(GetParam(), 1);
        ClockFit clock;
        const int samples = static_cast<int>(kSeconds * GetParam());
        int others = 0;
        for (int i = 0; i < samples; ++i) {
            const auto report = tracker.next();
            const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
            others += i > samples / 3 && reading.verdict != ClockVerdict::Good ? 1 : 0;
        }
        EXPECT_LT(others, 0.01 * samples);
    }
}

INSTANTIATE_TEST_SUITE_P(Rates, RegularTimestamps,
                         testing::Values(62.5, 100.0, 125.0, 200.0, 250.0, 500.0, 1000.0));

// A clock of whole milliseconds that was set by a number of them that is no multiple of its period.
TEST(ClockFitTicks, AreForgottenAtAStep) {
    for (const bool one_wrong : {false, true}) {
        for (const double rate_hz : {100.0, 125.0, 200.0}) {
            SimulatedTracker tracker{.rate_hz = rate_hz, .skew_ppm = 0.0, .jitter_ns = 0.1 * kMs};
            ClockFit clock;
            const int samples = static_cast<int>(40.0 * rate_hz);
            for (int i = 0; i < samples; ++i) {
                auto report = tracker.next();
                const bool affected = one_wrong ? i == samples / 2 : i >= samples / 2;
                // A step of little more than a period, which no length of it gives away.
                report.device_ns += affected ? (one_wrong ? 4'001'000'000 : 13'000'000) : 0;
                const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
                if (i > samples * 3 / 4) {
                    ASSERT_EQ(reading.verdict, ClockVerdict::Good) << rate_hz << " Hz, " << i;
                }
            }
            EXPECT_EQ(clock.steps(), one_wrong ? 0U : 1U);
        }
    }
}

TEST(TimestampTicks, AreTheDivisorOfIncrementsOrNothing) {
    TimestampTicks ticks;
    EXPECT_EQ(ticks.tick_ns(), 0);
    ticks.note(12'000, 12'000);
    EXPECT_EQ(ticks.tick_ns(), 0) << "regular so far";
    ticks.note(8'000, 12'000);
    EXPECT_EQ(ticks.tick_ns(), 4'000);
    constexpr std::int64_t kMost = std::numeric_limits<std::int64_t>::max();
    ticks.note(kMost, std::numeric_limits<std::int64_t>::min());
    EXPECT_EQ(ticks.tick_ns(), 4'000) << "a gap says nothing";
    TimestampTicks extreme;
    extreme.note(kMost, std::numeric_limits<std::int64_t>::min());
    extreme.note(kMost, 0);
    EXPECT_EQ(extreme.tick_ns(), 0);
    extreme.note(1, kMost);
    extreme.note(2, kMost);
    EXPECT_GE(extreme.tick_ns(), 0);
}

}  // namespace
}  // namespace gazeloop::time
