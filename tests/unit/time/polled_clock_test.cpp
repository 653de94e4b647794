// A host that asks for samples at fixed times, as USB does of interrupt endpoints.

#include <fmt/core.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>

#include "runtime/time/clock_fit.h"
#include "tests/unit/time/simulated_tracker.h"

namespace gazeloop::time {
namespace {

struct Polled {
    double rate_hz;
    std::int64_t polling_ns;
};

class PolledTracker : public testing::TestWithParam<Polled> {};

TEST_P(PolledTracker, IsNotStatedBetterThanItIs) {
    const auto [rate_hz, polling_ns] = GetParam();
    for (const double skew_ppm : {-50.0, -10.0, 10.0, 50.0}) {
        for (const double jitter_ms : {0.0, 0.2}) {
            std::size_t readings = 0;
            std::size_t outside = 0;
            double worst_ns = 0.0;
            std::int64_t stated_ns = 0;
            for (std::uint64_t seed = 1; seed <= 3; ++seed) {
                // It samples by its own clock, and beats with the host's.
                SimulatedTracker tracker{.rate_hz = rate_hz / (1.0 + skew_ppm * 1e-6),
                                         .skew_ppm = skew_ppm,
                                         .jitter_ns = std::max(jitter_ms * kMs, 1.0),
                                         .seed = seed,
                                         .polling_ns = static_cast<double>(polling_ns),
                                         .polling_phase = 0.37 * static_cast<double>(seed)};
                ClockFit clock(polling_ns);
                for (int i = 0; i < static_cast<int>(40.0 * rate_hz); ++i) {
                    auto report = tracker.next();
                    const ClockReading reading = clock.add(report.device_ns, report.arrived_ns);
                    if (reading.verdict == ClockVerdict::Unusable) {
                        continue;
                    }
                    ASSERT_GE(reading.uncertainty_ns, polling_ns);
                    ASSERT_LE(reading.host_ns, report.arrived_ns);
                    const double error = std::abs(error_ns(reading, report));
                    ++readings;
                    outside += error > static_cast<double>(reading.uncertainty_ns) + 1.0 ? 1 : 0;
                    worst_ns = i > 5 * rate_hz ? std::max(worst_ns, error) : worst_ns;
                    stated_ns = reading.uncertainty_ns;
                }
                EXPECT_EQ(clock.steps(), 0U) << seed;
            }
            fmt::print("{:+.0f} ppm, jitter {} ms: outside {:.2f} %, worst {:.2f} ms of {:.2f}\n",
                       skew_ppm, jitter_ms,
                       100.0 * static_cast<double>(outside) / static_cast<double>(readings),
                       worst_ns / kMs, static_cast<double>(stated_ns) / kMs);
            EXPECT_GT(readings, static_cast<std::size_t>(100 * rate_hz));
            EXPECT_LE(static_cast<double>(outside), 0.01 * static_cast<double>(readings))
                << skew_ppm << " ppm, jitter " << jitter_ms << " ms";
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Rates, PolledTracker,
                         testing::Values(Polled{60.0, 8'000'000}, Polled{90.0, 1'000'000},
                                         Polled{120.0, 8'000'000}, Polled{120.0, 4'000'000},
                                         Polled{120.0, 1'000'000}, Polled{120.0, 125'000},
                                         Polled{200.0, 1'000'000}, Polled{250.0, 4'000'000},
                                         Polled{250.0, 1'000'000}, Polled{500.0, 1'000'000},
                                         Polled{1000.0, 1'000'000}));

TEST(PolledClock, SaysWhatItsVerdictIsDueTo) {
    SimulatedTracker tracker{.polling_ns = 8.0 * kMs};
    ClockFit clock(8'000'000);
    for (int i = 0; i < 2000; ++i) {
        const auto report = tracker.next();
        clock.add(report.device_ns, report.arrived_ns);
    }
    EXPECT_EQ(clock.last().verdict, ClockVerdict::Coarse);
    EXPECT_EQ(clock.trouble(), ClockTrouble::Polled);
}

// After two minutes of silence everything begins anew, but the bus is the same.
TEST(PolledClock, OutlivesALongGap) {
    ClockFit clock(1'000'000);
    for (const std::int64_t gap_ns : {std::int64_t{0}, 200 * kSecond_ns}) {
        SimulatedTracker tracker{.jitter_ns = 1.0, .polling_ns = 1.0 * kMs};
        for (int i = 0; i < 1200; ++i) {
            const auto report = tracker.next();
            clock.add(report.device_ns + gap_ns, report.arrived_ns + gap_ns);
        }
        EXPECT_GE(clock.last().uncertainty_ns, 1'000'000);
    }
}

}  // namespace
}  // namespace gazeloop::time
