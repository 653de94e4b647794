#include "drivers/trace/clock/host_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <span>
#include <utility>

#include "tests/unit/drivers/trace/clock/trace_rows.h"

namespace gazeloop::drivers {
namespace {

using gaze::TraceFindingKind;
using ::testing::HasSubstr;
using ::testing::IsEmpty;
using ::testing::SizeIs;

constexpr std::int64_t kInterval = 8'333'333;
constexpr std::int64_t kEpoch = 1'700'000'000 * kSecond;

/// Rows of a device whose clock gains `ppm`, with host times at least 15 ms after the rows were
/// taken and exponential jitter on top.
struct Recording {
    std::vector<TraceRow> rows;
    std::vector<std::int64_t> taken_ns;  ///< host time, since the first row
    std::vector<std::int64_t> late_ns;
};

Recording recorded(std::size_t count, double ppm, double jitter_ms = 1.0,
                   std::int64_t interval_ns = kInterval) {
    Recording recording{good_rows(count, 3 * kSecond, interval_ns), {}, {}};
    std::mt19937_64 random(5);
    std::exponential_distribution<double> jitter(1.0 / (jitter_ms * 1e6));
    std::int64_t before = 0;
    for (TraceRow& row : recording.rows) {
        const auto device = static_cast<double>(*row.device_ticks - 3 * kSecond);
        const std::int64_t taken = std::llround(device / (1.0 + ppm * 1e-6));
        const std::int64_t arrived =
            std::max<std::int64_t>(before, taken + 15 * kMs + std::llround(jitter(random)));
        before = arrived;
        row.host_ns = kEpoch + arrived;
        recording.taken_ns.push_back(taken);
        recording.late_ns.push_back(arrived - taken - 15 * kMs);
    }
    return recording;
}

struct Fitted {
    DeviceTimes device;
    HostFit fit;
};

Fitted fitted(const std::vector<TraceRow>& rows) {
    Fitted result{device_times(RowsRead{rows}, 1.0), {}};
    std::vector<std::optional<std::int64_t>> host_ns;
    std::vector<std::uint64_t> lines;
    for (const std::size_t row : result.device.rows) {
        host_ns.push_back(rows[row].host_ns);
        lines.push_back(rows[row].line);
    }
    result.fit = fit_to_host(result.device, host_ns, lines);
    return result;
}

bool increases(std::span<const std::int64_t> times) {
    return std::adjacent_find(times.begin(), times.end(), std::greater_equal<>()) == times.end();
}

/// How far the times, and what they say of delays, are off at most.
struct Errors {
    double time_ms = 0.0;
    double delay_ms = 0.0;
};

Errors errors(const HostFit& fit, const Recording& recording) {
    Errors worst;
    for (std::size_t i = 0; i < fit.time_ns.size(); ++i) {
        worst.time_ms =
            std::max(worst.time_ms,
                     1e-6 * std::abs(static_cast<double>(fit.time_ns[i] - recording.taken_ns[i])));
        if (fit.delay_ns[i]) {
            worst.delay_ms = std::max(
                worst.delay_ms,
                1e-6 * std::abs(static_cast<double>(*fit.delay_ns[i] - recording.late_ns[i])));
        }
    }
    return worst;
}

TEST(HostFit, LeavesTimesOfClocksOfOneRateAsTheyAre) {
    for (const std::size_t count : {2U, 3U, 20U, 120U, 12'000U}) {
        const Recording recording = recorded(count, 0.0);
        const auto [device, fit] = fitted(recording.rows);
        EXPECT_EQ(fit.time_ns, device.time_ns) << count;
        EXPECT_EQ(fit.skew_ppm, 0.0);
        EXPECT_THAT(fit.findings, IsEmpty());
        EXPECT_EQ(*std::min_element(fit.delay_ns.begin(), fit.delay_ns.end()), 0);
        EXPECT_THAT(fit.text, HasSubstr("fitted to the host's clock: the same rate"));
    }
}

TEST(HostFit, LeavesTimesWithoutHostTimesAsTheyAre) {
    auto rows = good_rows(50);
    const auto [device, fit] = fitted(rows);
    EXPECT_EQ(fit.time_ns, device.time_ns);
    EXPECT_EQ(fit.delay_ns, memory::LongVector<std::optional<std::int64_t>>(50));
    EXPECT_EQ(fit.text, "the device's; no host times");
    rows[20].host_ns = 5;
    EXPECT_EQ(fitted(rows).fit.delay_ns[20], 0);
    EXPECT_THAT(fitted({}).fit.time_ns, IsEmpty());
}

TEST(HostFit, FollowsTheSkewFromTheFirstRowOn) {
    for (const double ppm : {-150.0, 150.0, -20.0, 400.0}) {
        const Recording recording = recorded(24'000, ppm);  // 200 s
        const auto [device, fit] = fitted(recording.rows);
        EXPECT_NEAR(fit.skew_ppm, -ppm, 2.0);
        const Errors worst = errors(fit, recording);
        EXPECT_LT(worst.time_ms, 0.1) << ppm;
        EXPECT_LT(worst.delay_ms, 0.1) << ppm;
        EXPECT_TRUE(increases(fit.time_ns));
        EXPECT_THAT(fit.findings, IsEmpty());
        EXPECT_THAT(fit.text, HasSubstr(ppm < 0.0 ? " ppm, within 0." : "fitted to the host's"));
    }
}

TEST(HostFit, FollowsACrystalThatDrifts) {
    Recording recording = recorded(36'000, 0.0);  // 300 s
    for (std::size_t i = 0; i < recording.rows.size(); ++i) {
        const double s = static_cast<double>(i) * kInterval * 1e-9;
        const auto gained = std::llround((50.0 * s + 0.1 * s * s) * 1e3);  // 50 to 110 ppm
        *recording.rows[i].device_ticks += gained;
    }
    const Errors worst = errors(fitted(recording.rows).fit, recording);
    EXPECT_LT(worst.time_ms, 0.2);
    EXPECT_LT(worst.delay_ms, 0.2);
}

TEST(HostFit, GoesOnByTheDeviceWhereTheHostsClockIsSet) {
    for (const std::int64_t by : {-900 * kSecond, 900 * kSecond, 3600 * kSecond, -2 * kSecond}) {
        for (const double ppm : {0.0, -150.0}) {
            Recording recording = recorded(6'000, ppm);
            for (std::size_t i = 3'000; i < 6'000; ++i) {
                *recording.rows[i].host_ns += by;
            }
            const auto [device, fit] = fitted(recording.rows);
            EXPECT_THAT(device.findings, IsEmpty());
            ASSERT_THAT(fit.findings, SizeIs(1));
            EXPECT_EQ(fit.findings[0].kind, TraceFindingKind::HostClockSet);
            EXPECT_EQ(fit.findings[0].line, 3'002U);
            EXPECT_NEAR(static_cast<double>(fit.findings[0].span_ns), static_cast<double>(by), 1e7);
            EXPECT_EQ(fit.steps, 1U);
            EXPECT_THAT(fit.text, HasSubstr(", 1 step"));
            const Errors worst = errors(fit, recording);
            EXPECT_LT(worst.time_ms, 0.25);
            EXPECT_LT(worst.delay_ms, 0.25);
        }
    }
}

TEST(HostFit, SaysWhereTheHostsClockIsSetAgainAndAgain) {
    for (const auto& [by, every] :
         {std::pair{-7 * kSecond, 100}, {7 * kSecond, 100}, {7 * kSecond, 120}}) {
        Recording recording = recorded(600, 0.0);
        for (std::size_t i = 0; i < recording.rows.size(); ++i) {
            *recording.rows[i].host_ns += by * (static_cast<std::int64_t>(i) / every);
        }
        const auto [device, fit] = fitted(recording.rows);
        // No gaze is so late that it does not count, in silence.
        const auto late = std::ranges::count_if(
            fit.delay_ns, [](const auto& delay) { return delay && *delay > kSecond / 2; });
        EXPECT_LE(late, 60) << by << " every " << every << ": " << fit.text;
        EXPECT_FALSE(fit.findings.empty()) << by << " every " << every << ": " << fit.text;
        EXPECT_EQ(fit.time_ns.back() - fit.time_ns.front(),
                  device.time_ns.back() - device.time_ns.front());
    }
}

TEST(HostFit, FindsShortStepsOfTheHostsClock) {
    for (const std::int64_t by : {-30 * kMs, 30 * kMs}) {
        Recording recording = recorded(6'000, 0.0);
        for (std::size_t i = 3'000; i < 6'000; ++i) {
            *recording.rows[i].host_ns += by;
        }
        const auto [device, fit] = fitted(recording.rows);
        ASSERT_THAT(fit.findings, SizeIs(1)) << by;
        EXPECT_EQ(fit.findings[0].kind, TraceFindingKind::HostClockSet);
        EXPECT_NEAR(static_cast<double>(fit.findings[0].line), 3'002.0, 12.0);
    }
}

TEST(HostFit, FindsShortStepsOfTheDevicesClock) {
    Recording recording = recorded(6'000, 0.0);
    move_times(recording.rows, 3'000, 6'000, 30 * kMs);
    const auto [device, fit] = fitted(recording.rows);
    ASSERT_THAT(fit.findings, SizeIs(1));
    EXPECT_EQ(fit.findings[0].kind, TraceFindingKind::DeviceClockSet);
    EXPECT_EQ(fit.findings[0].line, 3'002U);
    EXPECT_LT(errors(fit, recording).time_ms, 0.3);
}

TEST(HostFit, GoesOnByTheHostWhereTheDeviceIsSet) {
    Recording recording = recorded(9'000, -100.0);
    move_times(recording.rows, 3'000, 9'000, -700 * kSecond);
    move_times(recording.rows, 6'000, 9'000, -3 * kSecond);
    const auto [device, fit] = fitted(recording.rows);
    EXPECT_THAT(of_kind(device.findings, TraceFindingKind::DeviceClockSet), SizeIs(2));
    EXPECT_THAT(fit.findings, IsEmpty());
    EXPECT_EQ(fit.steps, 2U);
    EXPECT_LT(errors(fit, recording).time_ms, 0.3);
}

TEST(HostFit, TakesALateDeliveryForNoStep) {
    Recording recording = recorded(3'000, 0.0);
    // The host slept for 2 s, then read all that was queued at once.
    const std::int64_t awake = *recording.rows[1'240].host_ns;
    for (std::size_t i = 1'000; i < 1'240; ++i) {
        recording.late_ns[i] += awake - *recording.rows[i].host_ns;
        recording.rows[i].host_ns = awake;
    }
    const auto [device, fit] = fitted(recording.rows);
    EXPECT_THAT(fit.findings, IsEmpty());
    EXPECT_EQ(fit.time_ns, device.time_ns);
    EXPECT_LT(errors(fit, recording).delay_ms, 0.1);
}

TEST(HostFit, LeavesHostTimesOutThatNoNeighbourAgreesWith) {
    for (const std::int64_t by : {-900 * kSecond, 900 * kSecond, -kEpoch}) {
        for (const std::size_t at : {0U, 700U, 1'499U}) {
            Recording recording = recorded(1'500, 0.0);
            *recording.rows[at].host_ns += by;
            const auto [device, fit] = fitted(recording.rows);
            EXPECT_EQ(fit.outliers, 1U) << by << ' ' << at;
            EXPECT_FALSE(fit.delay_ns[at].has_value());
            EXPECT_EQ(fit.time_ns, device.time_ns);
            ASSERT_THAT(fit.findings, SizeIs(1));
            EXPECT_EQ(fit.findings[0].kind, TraceFindingKind::HostTimeOutlier);
            EXPECT_EQ(fit.findings[0].line, at + 2);
            EXPECT_EQ(fit.findings[0].rows, 1U);
            EXPECT_THAT(fit.text, HasSubstr(", 1 host time left out"));
        }
    }
}

TEST(HostFit, UsesWhatHostTimesThereAre) {
    Recording recording = recorded(24'000, -150.0);
    for (std::size_t i = 0; i < recording.rows.size(); ++i) {
        if (i % 7 != 3) {
            recording.rows[i].host_ns.reset();
        }
    }
    const auto [device, fit] = fitted(recording.rows);
    EXPECT_LT(errors(fit, recording).time_ms, 0.2);
    EXPECT_FALSE(fit.delay_ns[0].has_value());
    EXPECT_TRUE(fit.delay_ns[3].has_value());
}

// ---- A host's clock that stands -----------------------------------------------------------------

void expect_stand(const std::vector<gaze::TraceFinding>& findings, std::uint64_t line,
                  std::uint64_t rows) {
    ASSERT_THAT(findings, SizeIs(1));
    EXPECT_EQ(findings[0].kind, TraceFindingKind::ClockStoodStill);
    EXPECT_EQ(findings[0].line, line);
    EXPECT_EQ(findings[0].rows, rows);
    EXPECT_THAT(findings[0].text, HasSubstr("the host's clock stood still for "));
}

TEST(HostFit, GoesByTheDeviceWhereTheHostsClockStands) {
    Recording recording = recorded(2'000, 0.0);
    for (TraceRow& row : recording.rows) {
        row.host_ns = 0;
    }
    const auto [device, fit] = fitted(recording.rows);
    EXPECT_EQ(fit.time_ns, device.time_ns);
    EXPECT_EQ(fit.delay_ns, memory::LongVector<std::optional<std::int64_t>>(2'000));
    EXPECT_EQ(fit.text, "the device's; the host's stood still");
    expect_stand(fit.findings, 2, 2'000);
}

TEST(HostFit, LeavesOutHostTimesOfAStandButForTheFirst) {
    for (const std::size_t end : {1'200U, 2'000U}) {
        Recording recording = recorded(2'000, 0.0);
        for (std::size_t i = 1'000; i < end; ++i) {
            recording.rows[i].host_ns = recording.rows[1'000].host_ns;
        }
        const auto [device, fit] = fitted(recording.rows);
        EXPECT_EQ(fit.time_ns, device.time_ns);
        EXPECT_EQ(fit.steps, 0U);
        expect_stand(fit.findings, 1'002, end - 1'000);
        for (std::size_t i = 0; i < 2'000; ++i) {
            EXPECT_EQ(fit.delay_ns[i].has_value(), i <= 1'000 || i >= end) << i;
        }
        EXPECT_LT(errors(fit, recording).delay_ms, 0.1);
    }
}

TEST(HostFit, TakesTicksAndBatchesForNoStand) {
    for (const std::size_t batch : {1U, 4U, 30U}) {
        Recording recording = recorded(2'000, 0.0);
        for (std::size_t i = 0; i < 2'000; ++i) {
            const std::size_t last = std::min<std::size_t>(1'999, i / batch * batch + batch - 1);
            std::int64_t& host_ns = *recording.rows[i].host_ns;
            host_ns =
                batch == 1 ? host_ns / (16 * kMs) * (16 * kMs) : *recording.rows[last].host_ns;
        }
        const HostFit fit = fitted(recording.rows).fit;
        EXPECT_THAT(fit.findings, IsEmpty()) << batch;
        EXPECT_TRUE(std::all_of(fit.delay_ns.begin(), fit.delay_ns.end(),
                                [](const auto& delay) { return delay.has_value(); }));
    }
}

// ---- Short steps --------------------------------------------------------------------------------

TEST(HostFit, FindsAShortStepOfTheHostsClockOnceAndAtItsRow) {
    for (const std::int64_t by : {-66 * kMs, -20 * kMs, -8 * kMs, -5 * kMs, 4 * kMs, 5 * kMs,
                                  8 * kMs, 12 * kMs, 50 * kMs}) {
        Recording recording = recorded(3'000, 0.0);
        for (std::size_t i = 1'500; i < 3'000; ++i) {
            *recording.rows[i].host_ns += by;
        }
        const HostFit fit = fitted(recording.rows).fit;
        ASSERT_THAT(fit.findings, SizeIs(1)) << by;
        EXPECT_EQ(fit.findings[0].kind, TraceFindingKind::HostClockSet);
        EXPECT_NEAR(static_cast<double>(fit.findings[0].line), 1'502.0, 4.0) << by;
        EXPECT_NEAR(static_cast<double>(fit.findings[0].span_ns), static_cast<double>(by), 0.2e6);
        EXPECT_EQ(fit.steps, 1U);
        EXPECT_EQ(fit.skew_ppm, 0.0);
        EXPECT_LT(errors(fit, recording).time_ms, 0.01);
    }
}

TEST(HostFit, FindsAStepNextToALateReport) {
    for (const std::int64_t by : {-12 * kMs, 12 * kMs}) {
        Recording recording = recorded(3'000, 0.0);
        for (const std::size_t late : {1'498U, 1'499U, 1'500U, 1'501U}) {
            *recording.rows[late].host_ns += 5 * kMs;
            recording.late_ns[late] += 5 * kMs;
        }
        for (std::size_t i = 1'500; i < 3'000; ++i) {
            *recording.rows[i].host_ns += by;
        }
        const HostFit fit = fitted(recording.rows).fit;
        ASSERT_THAT(fit.findings, SizeIs(1)) << by;
        EXPECT_EQ(fit.findings[0].line, 1'502U);
        EXPECT_LT(errors(fit, recording).delay_ms, 0.2);
    }
}

TEST(HostFit, TakesALateLastRowForNoStep) {
    Recording recording = recorded(2'000, 0.0);
    *recording.rows.back().host_ns += 400 * kMs;
    const HostFit fit = fitted(recording.rows).fit;
    EXPECT_THAT(fit.findings, IsEmpty());
    EXPECT_NEAR(static_cast<double>(*fit.delay_ns.back()),
                static_cast<double>(recording.late_ns.back() + 400 * kMs), 0.1e6);
}

TEST(HostFit, FindsNoStepOfTheHostWhereTheDeviceIsSet) {
    Recording recording = recorded(3'000, 0.0);
    *recording.rows[1'500].host_ns += 6 * kMs;
    recording.late_ns[1'500] += 6 * kMs;
    move_times(recording.rows, 1'500, 3'000, -700 * kSecond);
    const auto [device, fit] = fitted(recording.rows);
    EXPECT_THAT(fit.findings, IsEmpty());
    EXPECT_LT(errors(fit, recording).time_ms, 0.1);
    EXPECT_LT(errors(fit, recording).delay_ms, 0.1);
}

TEST(HostFit, FindsAStepBackAmongLateReports) {
    Recording recording = recorded(3'000, 0.0);
    for (std::size_t i = 0; i < 3'000; i += 47) {
        *recording.rows[i].host_ns += 30 * kMs;
        recording.late_ns[i] += 30 * kMs;
    }
    for (std::size_t i = 1'500; i < 3'000; ++i) {
        *recording.rows[i].host_ns -= 50 * kMs;
    }
    const HostFit fit = fitted(recording.rows).fit;
    ASSERT_THAT(fit.findings, SizeIs(1));
    EXPECT_NEAR(static_cast<double>(fit.findings[0].line), 1'502.0, 4.0);
    EXPECT_LT(errors(fit, recording).delay_ms, 0.2);
}

TEST(HostFit, TakesAStepTooShortToFindForNoSkew) {
    Recording recording = recorded(3'000, 0.0);
    for (std::size_t i = 1'500; i < 3'000; ++i) {
        *recording.rows[i].host_ns += 3 * kMs / 2;
    }
    const HostFit fit = fitted(recording.rows).fit;
    EXPECT_EQ(fit.skew_ppm, 0.0);
    EXPECT_GT(fit.within_ns, kMs);
}

TEST(HostFit, FindsNothingInTwoShortStretchesWithAGapBetween) {
    for (const std::int64_t interval_ns : {kMs, kMs / 2}) {
        for (const std::int64_t gap_ns : {std::int64_t{0}, 2 * kSecond, 8'500 * kMs}) {
            for (const double jitter_ms : {0.3, 1.0, 3.0}) {
                Recording recording = recorded(3'000, 0.0, jitter_ms, interval_ns);
                for (std::size_t i = 1'500; i < 3'000; ++i) {
                    *recording.rows[i].host_ns += gap_ns;
                }
                move_times(recording.rows, 1'500, 3'000, gap_ns);
                const HostFit fit = fitted(recording.rows).fit;
                EXPECT_THAT(fit.findings, IsEmpty()) << gap_ns << ' ' << jitter_ms;
                EXPECT_EQ(fit.skew_ppm, 0.0) << gap_ns << ' ' << jitter_ms;
            }
        }
    }
}

// ---- Rates --------------------------------------------------------------------------------------

TEST(HostFit, SaysWhereRatesAreNoCrystals) {
    for (const double ratio : {1000.0, 1e6, 0.001, 1.02, 0.997}) {
        Recording recording = recorded(3'000, 0.0);
        for (TraceRow& row : recording.rows) {
            row.device_ticks =
                std::llround(static_cast<double>(*row.device_ticks - 3 * kSecond) / ratio);
        }
        DeviceTimes device;
        std::vector<std::optional<std::int64_t>> host_ns;
        std::vector<std::uint64_t> lines;
        for (const TraceRow& row : recording.rows) {
            const std::int64_t before = device.time_ns.empty() ? -1 : device.time_ns.back();
            device.time_ns.push_back(std::max(before + 1, *row.device_ticks));
            host_ns.push_back(row.host_ns);
            lines.push_back(row.line);
        }
        device.interval_ns = std::max<std::int64_t>(1, device.time_ns[1]);
        device.step_ns.assign(3'000, 0);
        device.reckoned.assign(3'000, false);
        const HostFit fit = fit_to_host(device, host_ns, lines);
        ASSERT_THAT(fit.findings, SizeIs(1)) << ratio;
        EXPECT_EQ(fit.findings[0].kind, TraceFindingKind::ClockRates);
        EXPECT_EQ(fit.time_ns, device.time_ns);
        EXPECT_FALSE(fit.delay_ns[1].has_value());
        if (ratio < 1e5) {  // else the device's ticks are coarser than its intervals
            EXPECT_NEAR(fit.host_per_device / ratio, 1.0, 1e-3);
        }
    }
}

TEST(HostFit, HasNoDelaysWhereTimesAreTheHosts) {
    auto rows = recorded(100, 0.0).rows;
    for (TraceRow& row : rows) {
        row.device_ticks.reset();
    }
    const auto [device, fit] = fitted(rows);
    EXPECT_EQ(fit.time_ns, device.time_ns);
    EXPECT_FALSE(fit.delay_ns[50].has_value());
    EXPECT_EQ(fit.text, "the host's; no row has a reading of the device's clock");
}

TEST(HostFit, BearsAnyTimes) {
    std::mt19937_64 random(3);
    for (const bool stands : {false, true}) {
        auto rows = good_rows(500);
        for (TraceRow& row : rows) {
            row.host_ns = static_cast<std::int64_t>(random());
            row.device_ticks = stands ? 7 : *row.device_ticks;
        }
        const auto [device, fit] = fitted(rows);
        EXPECT_EQ(fit.time_ns.size(), 500U);
        EXPECT_TRUE(increases(fit.time_ns));
    }
}

TEST(HostFit, SaysWhereRatesAreNoCrystalsHoweverShortTheTraceIs) {
    struct Case {
        std::size_t rows;
        double ratio;
    };
    for (const auto& [rows, ratio] :
         {Case{600, 2.0}, Case{600, 1.5}, Case{600, 1.05}, Case{600, 1.01}, Case{600, 0.95},
          Case{600, 0.5}, Case{960, 1.01}, Case{240, 1.05}, Case{240, 0.95}, Case{24, 2.0},
          Case{24, 0.5}}) {
        Recording recording = recorded(rows, 0.0);
        for (TraceRow& row : recording.rows) {
            *row.host_ns += std::llround(static_cast<double>(*row.device_ticks) * (ratio - 1.0));
        }
        const auto [device, fit] = fitted(recording.rows);
        ASSERT_THAT(fit.findings, SizeIs(1)) << rows << ' ' << ratio;
        EXPECT_EQ(fit.findings[0].kind, TraceFindingKind::ClockRates);
        EXPECT_EQ(fit.time_ns, device.time_ns);
        EXPECT_NEAR(fit.host_per_device, ratio, 0.03) << rows;
        EXPECT_EQ(fit.absurd_rates, ratio == 2.0 || ratio == 0.5) << rows << ' ' << ratio;
    }
}

/// Crystals are not so far off, but what is in a file may be.
TEST(HostFit, FollowsSkewsBeyondThoseOfCrystals) {
    for (const double ppm : {600.0, -600.0, -800.0, 950.0}) {
        const Recording longer = recorded(12'000, ppm);  // 100 s
        EXPECT_NEAR(fitted(longer.rows).fit.skew_ppm, -ppm, 5.0);
        EXPECT_LT(errors(fitted(longer.rows).fit, longer).time_ms, 0.15) << ppm;
        for (const std::size_t rows : {840U, 1'200U}) {  // 7 and 10 s
            const Recording recording = recorded(rows, ppm, 0.3);
            const HostFit fit = fitted(recording.rows).fit;
            EXPECT_NEAR(fit.skew_ppm, -ppm, 60.0) << rows;
            EXPECT_LT(errors(fit, recording).time_ms, 0.4) << ppm << ' ' << rows;
            EXPECT_THAT(fit.findings, IsEmpty()) << ppm;
        }
    }
}

}  // namespace
}  // namespace gazeloop::drivers
