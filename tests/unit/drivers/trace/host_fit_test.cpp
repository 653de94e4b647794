#include "drivers/trace/host_fit.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

#include "tests/unit/drivers/trace/trace_rows.h"

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
    Fitted result{device_times(rows, 1.0), {}};
    std::vector<std::optional<std::int64_t>> host_ns;
    std::vector<std::uint64_t> lines;
    for (const std::size_t row : result.device.rows) {
        host_ns.push_back(rows[row].host_ns);
        lines.push_back(rows[row].line);
    }
    result.fit = fit_to_host(result.device, host_ns, lines);
    return result;
}

bool increases(const std::vector<std::int64_t>& times) {
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
    EXPECT_EQ(fit.delay_ns, std::vector<std::optional<std::int64_t>>(50));
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
            EXPECT_THAT(fit.findings, IsEmpty());
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

}  // namespace
}  // namespace gazeloop::drivers
