#include "drivers/steam_frame/gaze_samples.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

#include "drivers/steam_frame/poll_times.h"

namespace gazeloop::drivers::steam_frame {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr std::int64_t kMs = 1'000'000;
constexpr std::int64_t kPeriod_ns = 11'111'111;
constexpr TrackerDelay kDelay{
    .least_ns = 17 * kMs, .uncertainty_ns = 2 * kMs, .polling_ns = PollTimes::kStep_ns};
/// Our clock is 3 s ahead of the raw one.
constexpr ClockPair kPair{
    .raw_ns = 100'000 * kMs, .monotonic_ns = 103'000 * kMs, .uncertainty_ns = 50};

GazeRecord good_record(double time_s) {
    GazeRecord record;
    record.time_s = time_s;
    record.filtered = {GazeRecord::Ray{{-0.28, 0.0, -0.96}, {4e-6, 9e-6, 1e-6}},
                       GazeRecord::Ray{{0.0, 0.0, -1.0}, {4e-6, 9e-6, 1e-6}}};
    record.before_fusion = {GazeRecord::Ray{{0.0, 0.6, -0.8}, {1e-5, 1e-5, 1e-5}},
                            GazeRecord::Ray{{0.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}};
    record.openness = {0.2, 0.9};
    return record;
}

/// Taken 17 ms before it is found, at the time of kPair.
gaze::GazeSample taken(GazeSamples& samples, std::uint32_t counter,
                       const GazeRecord& record = good_record(99.983)) {
    return samples.take(record, counter, kPair.monotonic_ns, kPair);
}

TEST(SteamFrameSamples, HaveTheStatedTimeInOurClock) {
    GazeSamples samples(kDelay, Rays::Filtered);
    const gaze::GazeSample sample = taken(samples, 5);
    EXPECT_EQ(sample.sampled, (time::Stamp{102'983 * kMs, time::StampKind::Measured}));
    EXPECT_EQ(sample.arrived, (time::Stamp{103'000 * kMs, time::StampKind::Measured}));
    EXPECT_FALSE(sample.ready.known());
    EXPECT_EQ(sample.device_ns, 99'983 * kMs);
    // 50 of the pair, 500 ppm of 17 ms.
    EXPECT_EQ(sample.uncertainty_ns, std::optional<std::int64_t>(50 + 8500));
    EXPECT_TRUE(samples.times_as_stated());
}

TEST(SteamFrameSamples, AreOfTheRaysThatWereAskedFor) {
    GazeSamples filtered(kDelay, Rays::Filtered);
    const gaze::GazeSample both = taken(filtered, 1);
    EXPECT_EQ(both.processing, gaze::GazeProcessing::Filtered);
    EXPECT_TRUE(both.eyes[0].valid && both.eyes[1].valid);
    EXPECT_NEAR(both.eyes[0].direction.x, -0.28, 1e-12);
    EXPECT_EQ(both.eyes[0].openness, 0.2);
    EXPECT_EQ(both.eyes[0].confidence, -1.0);
    // Straight ahead, X is across and Y is up; what lengthens the direction turns nothing.
    EXPECT_EQ(both.eyes[1].covariance, (gaze::DirectionCovariance{4e-6, 0.0, 9e-6}));
    // To the left by .28: across is (.96, 0, -.28).
    ASSERT_TRUE(both.eyes[0].covariance.has_value());
    EXPECT_NEAR(both.eyes[0].covariance->xx_rad2, .96 * .96 * 4e-6 + .28 * .28 * 1e-6, 1e-18);
    EXPECT_NEAR(both.eyes[0].covariance->xy_rad2, 0.0, 1e-18);
    EXPECT_NEAR(both.eyes[0].covariance->yy_rad2, 9e-6, 1e-18);

    GazeSamples raw(kDelay, Rays::BeforeFusion);
    const gaze::GazeSample left = taken(raw, 1);
    EXPECT_EQ(left.processing, gaze::GazeProcessing::Raw);
    EXPECT_TRUE(left.eyes[0].valid);
    EXPECT_NEAR(left.eyes[0].direction.y, 0.6, 1e-12);
    EXPECT_FALSE(left.eyes[1].valid) << "a direction of zero is a lost eye";
    EXPECT_FALSE(left.eyes[1].covariance.has_value());
    EXPECT_EQ(raw.counts().damaged, 0U);
}

TEST(SteamFrameSamples, LeaveOutWhatCannotBe) {
    const auto damaged = [](auto change) {
        GazeSamples samples(kDelay, Rays::Filtered);
        GazeRecord record = good_record(99.983);
        change(record);
        const gaze::GazeSample sample = taken(samples, 1, record);
        EXPECT_TRUE(sample.eyes[1].valid) << "the other eye is untouched";
        EXPECT_EQ(samples.take_change().has_value(), samples.counts().damaged > 0);
        return std::pair{sample, samples.counts().damaged};
    };
    const auto [lost, of_lost] = damaged([](auto& r) { r.filtered[0].direction.y = kNan; });
    EXPECT_FALSE(lost.eyes[0].valid);
    EXPECT_EQ(of_lost, 0U) << "what marks a lost eye is not known";
    const auto [longer, of_longer] = damaged([](auto& r) { r.filtered[0].direction *= 3.0; });
    EXPECT_FALSE(longer.eyes[0].valid);
    EXPECT_EQ(of_longer, 1U);
    for (const double variance : {-1e-9, 2.0, kNan, std::numeric_limits<double>::infinity()}) {
        const auto [sample, count] =
            damaged([variance](auto& r) { r.filtered[0].variances.z = variance; });
        EXPECT_TRUE(sample.eyes[0].valid);
        EXPECT_FALSE(sample.eyes[0].covariance.has_value());
        EXPECT_EQ(count, 1U);
    }
    const auto [silent, of_silent] = damaged([](auto& r) { r.filtered[0].variances *= 0.0; });
    EXPECT_FALSE(silent.eyes[0].covariance.has_value());
    EXPECT_EQ(of_silent, 0U);
    const auto [closed, of_closed] = damaged([](auto& r) { r.openness[0] = kNan; });
    EXPECT_EQ(closed.eyes[0].openness, -1.0);
    const auto [wide, of_wide] = damaged([](auto& r) { r.openness[0] = 1.2; });
    EXPECT_EQ(wide.eyes[0].openness, 1.0);
    for (const double time_s : {kNan, -1.0, 1e10, std::numeric_limits<double>::infinity()}) {
        const auto [sample, count] = damaged([time_s](auto& r) { r.time_s = time_s; });
        EXPECT_FALSE(sample.sampled.known());
        EXPECT_TRUE(sample.arrived.known());
        EXPECT_EQ(count, 1U);
    }
}

TEST(SteamFrameSamples, CountWhatTheCounterLeavesOut) {
    GazeSamples samples(kDelay, Rays::Filtered);
    std::int64_t now_ns = kPair.monotonic_ns;
    const auto lost = [&](std::uint32_t counter, std::int64_t later_ns = kPeriod_ns) {
        now_ns += later_ns;
        ClockPair pair = kPair;
        pair.monotonic_ns = now_ns;
        pair.raw_ns += now_ns - kPair.monotonic_ns;
        const double time_s = static_cast<double>(pair.raw_ns - 17 * kMs) * 1e-9;
        (void)samples.take(good_record(time_s), counter, now_ns, pair);
        return samples.lost_before_last();
    };
    EXPECT_EQ(lost(0xFFFFFFFD), 0U) << "the first";
    EXPECT_EQ(lost(0xFFFFFFFE), 0U);
    EXPECT_EQ(lost(1), 2U) << "over the end of its range";
    EXPECT_EQ(lost(5, 2'000 * kMs), 0U) << "a pause";
    EXPECT_EQ(lost(7), 1U);
    EXPECT_EQ(samples.counts().lost, 3U);
    EXPECT_EQ(lost(1), 0U) << "begun anew";
    EXPECT_EQ(samples.take_change(), std::optional<std::string>("its counter began anew"));
}

TEST(SteamFrameSamples, KnowTheirPeriodThoughMostAreMissed) {
    GazeSamples samples(kDelay, Rays::Filtered);
    const auto take = [&samples](std::uint32_t counter, double time_s) {
        ClockPair pair = kPair;
        pair.raw_ns += static_cast<std::int64_t>(time_s * 1e9);
        pair.monotonic_ns += static_cast<std::int64_t>(time_s * 1e9);
        (void)samples.take(good_record(99.983 + time_s), counter, pair.monotonic_ns, pair);
    };
    take(0xFFFFFFF0, 0.0);
    EXPECT_EQ(samples.period_ns(), 0);
    for (std::uint32_t i = 1; i <= 40; ++i) {
        take(0xFFFFFFF0 + 9 * i, 0.1 * i);  // every ninth of 90 Hz
        EXPECT_NEAR(static_cast<double>(samples.period_ns()), 11'111'111.0, 1e3) << i;
    }
    take(0xFFFFFFF0 + 9 * 40 + 1, 10.0);  // a pause
    take(0xFFFFFFF0 + 9 * 40 + 1, 10.0);  // nothing new, and back in time
    take(0xFFFFFFF0 + 9 * 40 + 2, 9.0);
    EXPECT_NEAR(static_cast<double>(samples.period_ns()), 11'111'111.0, 1e3);
}

TEST(SteamFrameSamples, FallBackToTheFitWhereStatedTimesAreOfAnotherClock) {
    GazeSamples samples(kDelay, Rays::Filtered);
    std::vector<std::string> told;
    gaze::GazeSample sample;
    // Stated times are of a clock that is 20 s behind the raw one; later they are right.
    for (std::uint32_t i = 0; i < 600; ++i) {
        ClockPair pair = kPair;
        pair.monotonic_ns += i * kPeriod_ns;
        pair.raw_ns += i * kPeriod_ns;
        const std::int64_t off_ns = i < 400 ? 20'000 * kMs : 0;
        const double time_s = static_cast<double>(pair.raw_ns - 17 * kMs - off_ns) * 1e-9;
        sample = samples.take(good_record(time_s), i, pair.monotonic_ns, pair);
        while (const auto line = samples.take_change()) {
            told.push_back(*line);
        }
        if (i < GazeSamples::kOddAges - 1) {
            EXPECT_FALSE(sample.sampled.known()) << i;
        }
        if (i == 399) {
            ASSERT_TRUE(sample.sampled.known());
            EXPECT_EQ(sample.sampled.kind, time::StampKind::Profile);
            EXPECT_NEAR(static_cast<double>(pair.monotonic_ns - sample.sampled.ns), 17e6, 0.3e6);
            EXPECT_FALSE(samples.times_as_stated());
        }
    }
    EXPECT_EQ(sample.sampled.kind, time::StampKind::Measured);
    EXPECT_TRUE(samples.times_as_stated());
    const auto tells = [&told](std::string_view text) {
        return std::ranges::count_if(
            told, [&](const std::string& line) { return line.find(text) != std::string::npos; });
    };
    EXPECT_EQ(tells("NOT of CLOCK_MONOTONIC_RAW as published, by that a sample is 20.017 s old"),
              1);
    EXPECT_EQ(tells("of CLOCK_MONOTONIC_RAW again"), 1);
}

TEST(SteamFrameClock, CarriesWithWhatTheKernelMayDiscipline) {
    const CarriedTime same = carried(kPair.raw_ns, kPair);
    EXPECT_EQ(same.ns, kPair.monotonic_ns);
    EXPECT_EQ(same.uncertainty_ns, 50);
    const CarriedTime second = carried(kPair.raw_ns - 1'000 * kMs, kPair);
    EXPECT_EQ(second.ns, kPair.monotonic_ns - 1'000 * kMs);
    EXPECT_EQ(second.uncertainty_ns, 50 + 500'000);
    const CarriedTime far = carried(std::numeric_limits<std::int64_t>::max(), kPair);
    EXPECT_EQ(far.ns, std::numeric_limits<std::int64_t>::max());
    const ClockPair now = read_clocks();
    EXPECT_GT(now.raw_ns, 0);
    EXPECT_GT(now.monotonic_ns, 0);
    EXPECT_GE(now.uncertainty_ns, 0);
}

TEST(PollTimes, FindASampleWithFewLooksAndSoon) {
    for (const double rate_hz : {30.0, 90.0, 200.0, 1000.0}) {
        const auto period_ns = static_cast<std::int64_t>(1e9 / rate_hz);
        PollTimes poll;
        std::int64_t looks = 0;
        std::int64_t latest_ns = 0;
        std::int64_t taken = 0;
        std::int64_t published = 0;
        constexpr std::int64_t kSamples = 2000;
        for (std::int64_t now_ns = 0; published < kSamples; now_ns = poll.next_ns()) {
            ++looks;
            published = now_ns / period_ns;
            if (published == taken) {
                poll.missed(now_ns);
                continue;
            }
            if (taken > 10) {  // the period is known
                latest_ns = std::max(latest_ns, now_ns - published * period_ns);
                EXPECT_EQ(published, taken + 1) << rate_hz;
            }
            taken = published;
            poll.found(now_ns, taken > 10 ? period_ns : 0, now_ns - published * period_ns);
        }
        EXPECT_LE(latest_ns, PollTimes::kStep_ns) << rate_hz;
        EXPECT_LT(static_cast<double>(looks), 6.0 * kSamples) << rate_hz;
    }
}

// Every fifth sample comes most of a period late; those after it come when they are due.
TEST(PollTimes, AreNotPutOffByASampleThatIsLate) {
    PollTimes poll;
    std::int64_t taken = 0;
    std::int64_t latest_ns = 0;
    for (std::int64_t now_ns = 0; taken < 1000; now_ns = poll.next_ns()) {
        const std::int64_t next = taken + 1;
        const std::int64_t due_ns = next * kPeriod_ns;
        const std::int64_t there_ns = due_ns + (next % 5 == 0 ? kPeriod_ns * 3 / 4 : 0);
        if (now_ns < there_ns) {
            poll.missed(now_ns);
            continue;
        }
        if (taken > 10) {
            latest_ns = std::max(latest_ns, now_ns - there_ns);
        }
        taken = next;
        poll.found(now_ns, kPeriod_ns, now_ns - due_ns);
    }
    EXPECT_LE(latest_ns, 2 * PollTimes::kStep_ns);
}

TEST(PollTimes, LookSeldomIntoSilence) {
    PollTimes poll;
    poll.found(0, kPeriod_ns, std::nullopt);
    std::int64_t looks = 0;
    for (std::int64_t now_ns = poll.next_ns(); now_ns < 1'000 * kMs; now_ns = poll.next_ns()) {
        poll.missed(now_ns);
        ++looks;
    }
    EXPECT_LT(looks, 700);
    EXPECT_EQ(poll.next_ns() - 1'000 * kMs < 5 * kMs, true);
}

}  // namespace
}  // namespace gazeloop::drivers::steam_frame
