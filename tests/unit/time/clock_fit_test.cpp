#include "runtime/time/clock_fit.h"

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <limits>
#include <vector>

#include "sim/random.h"
#include "tests/support/allocation_counter.h"
#include "tests/unit/time/simulated_tracker.h"

namespace gazeloop::time {
namespace {

double percentile(std::vector<double> values, double percent) {
    const auto at =
        static_cast<std::size_t>(percent / 100.0 * static_cast<double>(values.size() - 1));
    std::ranges::nth_element(values, values.begin() + static_cast<std::ptrdiff_t>(at));
    return values[at];
}

class KnownClock : public testing::TestWithParam<Jitter> {};

// The targets: 120 Hz, 1 ms of one-sided jitter, 50 ppm; after 5 s within 100 us at p99.
TEST_P(KnownClock, IsFollowedToATenthOfAMillisecond) {
    std::vector<double> errors;
    std::size_t outside = 0;
    for (std::uint64_t seed = 1; seed <= 200; ++seed) {
        SimulatedTracker tracker{.jitter = GetParam(), .seed = seed};
        ClockFit clock;
        for (int i = 0; i < 30 * 120; ++i) {
            const auto report = tracker.next();
            const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
            if (i < 5 * 120) {
                continue;
            }
            ASSERT_EQ(reading.verdict, ClockVerdict::Good) << seed << ' ' << i;
            EXPECT_LE(reading.host_ns, report.arrived_ns);
            const double error = std::abs(error_ns(reading, report));
            errors.push_back(error);
            outside += error > static_cast<double>(reading.uncertainty_ns) ? 1 : 0;
        }
        EXPECT_NEAR(clock.skew_ppm(), 50.0, 12.0);
        EXPECT_EQ(clock.steps(), 0U) << seed;
        EXPECT_EQ(clock.trouble(), ClockTrouble::None);
    }
    const double p99 = percentile(errors, 99.0);
    fmt::print(
        "error p50 {:.1f} us, p99 {:.1f} us, max {:.1f} us; outside its uncertainty {:.3f} %\n",
        percentile(errors, 50.0) / 1e3, p99 / 1e3, percentile(errors, 100.0) / 1e3,
        100.0 * static_cast<double>(outside) / static_cast<double>(errors.size()));
    EXPECT_LT(p99, 100e3);
    EXPECT_LT(static_cast<double>(outside), 0.01 * static_cast<double>(errors.size()));
}

INSTANTIATE_TEST_SUITE_P(Jitters, KnownClock,
                         testing::Values(Jitter::None, Jitter::Uniform, Jitter::Exponential));

// What it says of its uncertainty holds from the first reading on.
TEST_P(KnownClock, StatesAnUncertaintyThatHolds) {
    for (const double rate_hz : {30.0, 120.0, 1000.0}) {
        for (const double skew_ppm : {-200.0, 0.0, 200.0}) {
            std::size_t readings = 0;
            std::size_t outside = 0;
            for (std::uint64_t seed = 1; seed <= 60; ++seed) {
                SimulatedTracker tracker{
                    .rate_hz = rate_hz, .skew_ppm = skew_ppm, .jitter = GetParam(), .seed = seed};
                ClockFit clock;
                for (int i = 0; i < static_cast<int>(6 * rate_hz); ++i) {
                    const auto report = tracker.next();
                    const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
                    if (reading.verdict != ClockVerdict::Unusable) {
                        ++readings;
                        outside += std::abs(error_ns(reading, report)) >
                                           static_cast<double>(reading.uncertainty_ns) + 1.0
                                       ? 1
                                       : 0;
                    }
                }
            }
            EXPECT_GT(readings, static_cast<std::size_t>(5 * rate_hz) * 60);
            EXPECT_LT(static_cast<double>(outside), 0.01 * static_cast<double>(readings))
                << rate_hz << " Hz, " << skew_ppm << " ppm";
        }
    }
}

// The first readings of many streams, each by itself: no mean over seconds hides them.
TEST(ClockFit, StatesAnUncertaintyThatHoldsForTheFirstReadingsToo) {
    constexpr std::size_t kStreams = 2000;
    constexpr std::size_t kFirst = 32;
    for (const Jitter jitter : {Jitter::Uniform, Jitter::Exponential}) {
        std::array<std::size_t, kFirst> known{};
        std::array<std::size_t, kFirst> outside{};
        for (std::uint64_t seed = 1; seed <= kStreams; ++seed) {
            SimulatedTracker tracker{.jitter = jitter, .seed = seed};
            ClockFit clock;
            for (std::size_t i = 0; i < kFirst; ++i) {
                const auto report = tracker.next();
                const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
                if (reading.verdict != ClockVerdict::Unusable) {
                    ++known[i];
                    outside[i] += std::abs(error_ns(reading, report)) >
                                          static_cast<double>(reading.uncertainty_ns) + 1.0
                                      ? 1
                                      : 0;
                }
            }
        }
        EXPECT_GT(known[kFirst / 2], kStreams * 9 / 10);
        for (std::size_t i = 0; i < kFirst; ++i) {
            EXPECT_LE(outside[i], kStreams / 100) << "sample " << i;
        }
    }
}

TEST(ClockFitSteps, AreFoundWithinTenSamplesAndThenFollowed) {
    for (const Jitter jitter : {Jitter::None, Jitter::Uniform, Jitter::Exponential}) {
        for (const double by_ms :
             {-3.6e6, -1000.0, -25.0, -8.333, -6.0, 6.0, 8.333, 25.0, 1000.0, 3.6e6}) {
            for (std::uint64_t seed = 1; seed <= 20; ++seed) {
                SimulatedTracker tracker{.jitter = jitter, .seed = seed};
                ClockFit clock;
                int found_after = -1;
                std::vector<double> errors;
                for (int i = 0; i < 20 * 120; ++i) {
                    if (i == 10 * 120) {
                        tracker.step_ns = by_ms * kMs;
                    }
                    const auto report = tracker.next();
                    const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
                    if (reading.stepped) {
                        ASSERT_GE(i, 10 * 120) << "no step yet";
                        ASSERT_EQ(found_after, -1) << "found twice";
                        found_after = i - 10 * 120 + 1;
                    }
                    // Not even before the step is found.
                    if (reading.verdict != ClockVerdict::Unusable && i >= 10 * 120) {
                        EXPECT_LT(std::abs(error_ns(reading, report)),
                                  static_cast<double>(reading.uncertainty_ns) + 1.0 * kMs)
                            << by_ms << " ms, sample " << i << ", seed " << seed;
                    }
                    if (i >= 15 * 120) {
                        errors.push_back(std::abs(error_ns(reading, report)));
                        EXPECT_EQ(reading.verdict, ClockVerdict::Good);
                    }
                }
                EXPECT_GT(found_after, 0) << by_ms << " ms, seed " << seed;
                EXPECT_LE(found_after, 10) << by_ms << " ms, seed " << seed;
                EXPECT_LT(percentile(errors, 99.0), 200e3) << by_ms << " ms, seed " << seed;
            }
        }
    }
}

// Too short to be found among the jitter, but the timestamp that jumped gives it away: until the
// line tells more, it may be as wrong as all samples since are late.
TEST(ClockFitSteps, TooShortToBeFoundAreInTheUncertainty) {
    for (const Jitter jitter : {Jitter::None, Jitter::Uniform, Jitter::Exponential}) {
        for (const double by_ms : {-4.0, -3.0, -2.0, -1.0, 1.0, 2.0, 3.0, 4.0}) {
            std::size_t known = 0;
            std::size_t outside = 0;
            for (std::uint64_t seed = 1; seed <= 50; ++seed) {
                SimulatedTracker tracker{.jitter = jitter, .seed = seed};
                ClockFit clock;
                for (int i = 0; i < 12 * 120; ++i) {
                    tracker.step_ns = i >= 10 * 120 ? by_ms * kMs : 0.0;
                    const auto report = tracker.next();
                    const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
                    if (i >= 10 * 120 && reading.verdict != ClockVerdict::Unusable) {
                        ++known;
                        outside += std::abs(error_ns(reading, report)) >
                                           static_cast<double>(reading.uncertainty_ns) + 1.0
                                       ? 1
                                       : 0;
                    }
                }
            }
            EXPECT_GT(known, 50U * 200U) << by_ms << " ms";
            EXPECT_LE(outside, known / 100) << by_ms << " ms";
        }
    }
}

// One that is late by as much as the clock was set looks as if nothing had happened, but for its
// timestamp, which is not where the next one belongs.
TEST(ClockFitSteps, AreNotBelievedWhereALateSampleHidesThem) {
    for (const int hidden : {1, 2}) {
        SimulatedTracker tracker{.jitter = Jitter::None};
        ClockFit clock;
        int found_after = -1;
        for (int i = 0; i < 12 * 120; ++i) {
            constexpr int kStepAt = 10 * 120;
            tracker.step_ns = i >= kStepAt ? 6.0 * kMs : 0.0;
            auto report = tracker.next();
            // The first after the step, or the second.
            report.arrived_ns += i == kStepAt + hidden - 1 ? 6'000'000 : 0;
            const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
            found_after = reading.stepped ? i - kStepAt + 1 : found_after;
            EXPECT_TRUE(i < kStepAt || found_after > 0 || reading.verdict == ClockVerdict::Unusable)
                << i - kStepAt << ", hidden " << hidden;
        }
        EXPECT_GT(found_after, 0);
        EXPECT_LE(found_after, 10);
    }
}

TEST(ClockFit, LateDeliveryIsNoStep) {
    SimulatedTracker tracker;
    ClockFit clock;
    std::int64_t held_until_ns = 0;
    for (int i = 0; i < 40 * 120; ++i) {
        auto report = tracker.next();
        if (i % 600 == 599) {  // the host sleeps for 150 ms, then reads what has piled up
            held_until_ns = report.arrived_ns + 150'000'000;
        }
        const bool congested = i > 3000 && i < 3100;  // everything 6 ms later for a while
        report.arrived_ns += congested ? 6'000'000 : 0;
        report.arrived_ns = std::max(report.arrived_ns, held_until_ns);
        const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
        if (i > 600) {
            ASSERT_NE(reading.verdict, ClockVerdict::Unusable) << i;
            EXPECT_LT(std::abs(error_ns(reading, report)), 150e3) << i;
        }
    }
    EXPECT_EQ(clock.steps(), 0U);
}

// Reports that were waiting when the device was opened come all at once: only the last of them can
// be fresh, and nobody knows whether it is.
TEST(ClockFit, ABacklogIsNoClock) {
    std::size_t readings = 0;
    std::size_t outside = 0;
    for (std::uint64_t seed = 1; seed <= 50; ++seed) {
        SimulatedTracker tracker{.seed = seed};
        ClockFit clock;
        std::int64_t opened_ns = 0;
        for (int i = 0; i < 10 * 120; ++i) {
            auto report = tracker.next();
            opened_ns = i == 0 ? report.arrived_ns + 500'000'000 : opened_ns;
            const bool waited = report.arrived_ns < opened_ns;
            report.arrived_ns = std::max(report.arrived_ns, opened_ns + std::int64_t{i} * 20'000);
            const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
            if (reading.verdict != ClockVerdict::Unusable) {
                EXPECT_FALSE(waited) << i << ", seed " << seed;
                ++readings;
                outside += std::abs(error_ns(reading, report)) >
                                   static_cast<double>(reading.uncertainty_ns) + 1.0
                               ? 1
                               : 0;
            }
        }
        EXPECT_EQ(clock.steps(), 0U) << seed;
        EXPECT_EQ(clock.last().verdict, ClockVerdict::Good);
    }
    EXPECT_LT(static_cast<double>(outside), 0.01 * static_cast<double>(readings));
}

TEST(ClockFit, GapsCostNothing) {
    SimulatedTracker tracker;
    ClockFit clock;
    for (int i = 0; i < 60 * 120; ++i) {
        const auto report = tracker.next();
        const bool silent = (i > 1000 && i < 1200) || (i > 3000 && i < 6000) || i % 7 == 0;
        if (silent) {
            continue;
        }
        const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
        if (i > 600) {
            ASSERT_EQ(reading.verdict, ClockVerdict::Good) << i;
            EXPECT_LT(std::abs(error_ns(reading, report)), 300e3) << i;
        }
    }
    EXPECT_EQ(clock.steps(), 0U);
    const auto report = tracker.next();  // an hour later it begins anew
    const std::int64_t hour_ns = 3600 * kSecond_ns;
    EXPECT_EQ(clock.add(report.device_ns + hour_ns, report.arrived_ns + hour_ns).verdict,
              ClockVerdict::Unusable);
    EXPECT_EQ(clock.trouble(), ClockTrouble::Settling);
}

// Of a clock that was slow, jittery and set, nothing is left: what follows is what a new one says.
TEST(ClockFit, ALongGapForgetsWhatWasBefore) {
    SimulatedTracker before{.skew_ppm = 400.0, .jitter_ns = 5.0 * kMs};
    ClockFit clock;
    for (int i = 0; i < 12 * 120; ++i) {
        before.step_ns = i >= 10 * 120 ? 500.0 * kMs : 0.0;
        const auto report = before.next();
        clock.add(report.device_ns, report.arrived_ns);
    }
    ASSERT_EQ(clock.steps(), 1U);
    ASSERT_NEAR(clock.skew_ppm(), 400.0, 51.0);

    SimulatedTracker after{.skew_ppm = -400.0, .jitter_ns = 0.2 * kMs, .seed = 2};
    ClockFit fresh;
    const std::int64_t gap_ns = 200 * kSecond_ns;
    for (int i = 0; i < 10 * 120; ++i) {
        const auto report = after.next();
        const std::int64_t device_ns = report.device_ns + gap_ns;
        const std::int64_t arrived_ns = report.arrived_ns + gap_ns;
        const ClockReading reading = clock.add(device_ns, arrived_ns);
        const ClockReading expected = fresh.add(device_ns, arrived_ns);
        ASSERT_EQ(reading.verdict, expected.verdict) << i;
        ASSERT_EQ(reading.host_ns, expected.host_ns) << i;
        ASSERT_EQ(reading.uncertainty_ns, expected.uncertainty_ns) << i;
        ASSERT_EQ(clock.trouble(), fresh.trouble()) << i;
    }
    EXPECT_EQ(clock.steps(), 1U) << "a gap is none, and what was counted stays";
}

// The crystal is the same one, and so is the way to the host.
TEST(ClockFitSteps, KeepTheSkewAndTheJitter) {
    SimulatedTracker tracker{.skew_ppm = 300.0};
    ClockFit clock;
    double jitter_before_ns = 0.0;
    for (int i = 0; i < 14 * 120; ++i) {
        constexpr int kStepAt = 10 * 120;
        tracker.step_ns = i >= kStepAt ? 500.0 * kMs : 0.0;
        const auto report = tracker.next();
        const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
        jitter_before_ns = i < kStepAt ? clock.jitter_ns() : jitter_before_ns;
        if (reading.stepped) {
            EXPECT_EQ(clock.jitter_ns(), jitter_before_ns);
        }
        if (clock.steps() > 0) {
            // By as much as a crystal may drift, and by how well it was known.
            EXPECT_NEAR(clock.skew_ppm(), 300.0, 75.0) << i;
        }
    }
    EXPECT_EQ(clock.steps(), 1U);
    EXPECT_NEAR(jitter_before_ns, 1.0 * kMs, 0.5 * kMs);
}

TEST(ClockFit, OneWrongTimestampIsLeftOut) {
    for (const double by_ms : {-500.0, 500.0, 1e12}) {
        SimulatedTracker tracker;
        ClockFit clock;
        int wrongs = 0;
        int in_question = 0;  // right after a wrong one
        for (int i = 0; i < 20 * 120; ++i) {
            auto report = tracker.next();
            const bool wrong = i > 600 && i % 100 == 0;
            report.device_ns += wrong ? std::llround(by_ms * kMs) : 0;
            const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
            if (i > 600) {
                const bool known = reading.verdict != ClockVerdict::Unusable;
                EXPECT_FALSE(wrong && known) << i;
                wrongs += wrong ? 1 : 0;
                in_question += !wrong && !known ? 1 : 0;
                EXPECT_TRUE(!known || std::abs(error_ns(reading, report)) < 100e3) << i;
            }
        }
        // An early one could be a step: two more are waited for.
        EXPECT_LE(in_question, by_ms > 0.0 ? 2 * wrongs : 5);
        EXPECT_EQ(clock.steps(), 0U);
    }
}

// One report that is repeated tells nothing of how coarse a clock is.
TEST(ClockFit, ARepeatedTimestampCostsThatReadingAlone) {
    for (const double rate_hz : {30.0, 60.0, 120.0, 1000.0}) {
        for (const int at : {1, 3, 40, 600}) {
            SimulatedTracker tracker{.rate_hz = rate_hz, .jitter_ns = 0.1 * kMs};
            ClockFit clock;
            std::int64_t before_ns = 0;
            for (int i = 0; i < 1000; ++i) {
                auto report = tracker.next();
                report.device_ns = i == at ? before_ns : report.device_ns;
                before_ns = report.device_ns;
                const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
                const bool known = reading.verdict != ClockVerdict::Unusable;
                EXPECT_TRUE(known || i < 24 || i == at) << rate_hz << " Hz, " << at << ": " << i;
                EXPECT_TRUE(!known || std::abs(error_ns(reading, report)) <=
                                          static_cast<double>(reading.uncertainty_ns) + 0.2 * kMs)
                    << rate_hz << " Hz, " << at << ": " << i;
            }
            EXPECT_EQ(clock.trouble(), ClockTrouble::None) << rate_hz << " Hz, " << at;
        }
    }
}

// The first reports may be old ones, of another run of the device's clock, behind or ahead.
TEST(ClockFit, StaleFirstReportsAreSoonForgotten) {
    for (const double by_s : {-3600.0, -60.0, -2.0, 2.0, 60.0, 3600.0, 9e9}) {
        for (const int stale : {1, 2, 3, 8, 15, 16, 17, 40}) {
            SimulatedTracker tracker{.jitter_ns = 0.3 * kMs};
            ClockFit clock;
            int unknown = 0;
            for (int i = 0; i < 600; ++i) {
                auto report = tracker.next();
                report.device_ns += i < stale ? std::llround(by_s * 1e9) : 0;
                const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
                if (i < stale) {
                    continue;
                }
                unknown += reading.verdict == ClockVerdict::Unusable ? 1 : 0;
                EXPECT_TRUE(reading.verdict == ClockVerdict::Unusable ||
                            std::abs(error_ns(reading, report)) < 2.0 * kMs)
                    << by_s << " s, " << stale << ": " << i;
            }
            EXPECT_LE(unknown, 24) << by_s << " s, " << stale;
            EXPECT_EQ(clock.trouble(), ClockTrouble::None) << by_s << " s, " << stale;
        }
    }
}

// Set by centuries, a clock is as well known as before: lags count from the new line.
TEST(ClockFitSteps, MayBeAsLongAsNumbersAre) {
    for (const double by_s : {-9e9, 9e9}) {
        SimulatedTracker tracker;
        ClockFit clock;
        for (int i = 0; i < 3600; ++i) {
            auto report = tracker.next();
            report.device_ns += i >= 1200 ? std::llround(by_s * 1e9) : 0;
            const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
            EXPECT_TRUE(reading.verdict == ClockVerdict::Unusable ||
                        std::abs(error_ns(reading, report)) <=
                            static_cast<double>(reading.uncertainty_ns) + 1.0 * kMs)
                << by_s << " s: " << i;
            EXPECT_TRUE(i < 3000 || std::abs(error_ns(reading, report)) < 100e3) << i;
        }
        EXPECT_EQ(clock.steps(), 1U);
    }
}

/// The verdict after 10 s of timestamps that are what `lie` makes of the true ones.
ClockFit after_lies(const std::function<std::int64_t(std::int64_t device_ns, int sample)>& lie,
                    double rate_hz = 120.0) {
    SimulatedTracker tracker{.rate_hz = rate_hz};
    ClockFit clock;
    int usable = 0;
    for (int i = 0; i < static_cast<int>(20 * rate_hz); ++i) {
        const auto report = tracker.next();
        const ClockReading reading = clock.add(lie(report.device_ns, i), report.arrived_ns);
        if (reading.verdict != ClockVerdict::Unusable) {
            ++usable;
            EXPECT_LE(reading.host_ns, report.arrived_ns);
        }
    }
    fmt::print("usable {} times: {} ({}), uncertainty {} us\n", usable,
               kClockVerdictNames[static_cast<std::size_t>(clock.last().verdict)],
               kClockTroubleNames[static_cast<std::size_t>(clock.trouble())],
               clock.last().uncertainty_ns / 1000);
    return clock;
}

TEST(ClockFitLies, AreSeenThrough) {
    const auto expect_unusable = [](const ClockFit& clock, ClockTrouble trouble) {
        EXPECT_EQ(clock.last().verdict, ClockVerdict::Unusable);
        EXPECT_EQ(clock.trouble(), trouble);
    };
    expect_unusable(after_lies([](std::int64_t, int) { return std::int64_t{42}; }),
                    ClockTrouble::StandsStill);
    expect_unusable(after_lies([](std::int64_t ns, int) { return ns / kSecond_ns * kSecond_ns; }),
                    ClockTrouble::StandsStill);
    // Whole seconds where the field counts microseconds.
    expect_unusable(after_lies([](std::int64_t ns, int) { return ns / kSecond_ns * 1000; }),
                    ClockTrouble::StandsStill);
    expect_unusable(after_lies([](std::int64_t ns, int) { return -ns; }), ClockTrouble::Restless);
    expect_unusable(after_lies([](std::int64_t ns, int) { return ns * 2; }),
                    ClockTrouble::Restless);
    expect_unusable(after_lies([](std::int64_t ns, int) { return ns / 2; }), ClockTrouble::Late);
    expect_unusable(after_lies([](std::int64_t ns, int) { return ns / 1000; }),
                    ClockTrouble::Jitter);
    expect_unusable(after_lies([](std::int64_t ns, int i) { return ns - (i / 20) * kSecond_ns; }),
                    ClockTrouble::Restless);
    // Noise without relation to anything.
    sim::Random random{7, sim::Stream::Noise};
    EXPECT_EQ(after_lies([&](std::int64_t, int) {
                  return static_cast<std::int64_t>(random.uniform(-9e18, 9e18));
              })
                  .last()
                  .verdict,
              ClockVerdict::Unusable);
    EXPECT_EQ(after_lies([](std::int64_t, int i) {
                  return i % 2 == 0 ? std::numeric_limits<std::int64_t>::min()
                                    : std::numeric_limits<std::int64_t>::max();
              })
                  .last()
                  .verdict,
              ClockVerdict::Unusable);
}

TEST(ClockFitLies, TicksOfSomeMillisecondsAreCoarse) {
    const auto in_steps_of = [](std::int64_t tick_ns, double rate_hz = 120.0) {
        return after_lies([=](std::int64_t ns, int) { return ns / tick_ns * tick_ns; }, rate_hz);
    };
    EXPECT_EQ(in_steps_of(100'000).last().verdict, ClockVerdict::Good);
    EXPECT_EQ(in_steps_of(4'000'000).last().verdict, ClockVerdict::Coarse);
    EXPECT_EQ(in_steps_of(4'000'000).trouble(), ClockTrouble::CoarseTicks);
    EXPECT_EQ(in_steps_of(4'000'000, 1000.0).last().verdict, ClockVerdict::Coarse);
    EXPECT_EQ(in_steps_of(16'000'000, 1000.0).last().verdict, ClockVerdict::Unusable);
    // A clock that counts frames is regular, not coarse.
    SimulatedTracker tracker{.skew_ppm = 0.0, .jitter = Jitter::Uniform};
    ClockFit clock;
    for (int i = 0; i < 2000; ++i) {
        const auto report = tracker.next();
        clock.add(std::int64_t{i} * 8'333'333, report.arrived_ns);
    }
    EXPECT_EQ(clock.last().verdict, ClockVerdict::Good);
}

TEST(ClockFit, AllocatesNothing) {
    SimulatedTracker tracker;
    ClockFit clock;
    const std::size_t before = tests::allocations_of_this_thread();
    for (int i = 0; i < 10'000; ++i) {
        tracker.step_ns = i % 3000 == 2999 ? tracker.step_ns + 20.0 * kMs : tracker.step_ns;
        const auto report = tracker.next();
        clock.add(report.device_ns, report.arrived_ns);
    }
    EXPECT_EQ(tests::allocations_of_this_thread(), before);
    EXPECT_EQ(clock.steps(), 3U);
}

}  // namespace
}  // namespace gazeloop::time
