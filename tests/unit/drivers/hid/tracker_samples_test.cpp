#include "drivers/hid/tracker_samples.h"

#include <gtest/gtest.h>

#include <cstring>

#include "tests/support/allocation_counter.h"
#include "tests/unit/drivers/hid/descriptor_items.h"

namespace gazeloop::drivers::hid {
namespace {

constexpr std::int64_t kMs = 1'000'000;

TrackerSamples samples_of(const std::vector<std::uint8_t>& descriptor) {
    return {value_or_throw(find_eye_tracker(value_or_throw(parse_report_descriptor(descriptor)))),
            ScreenGeometry{}, TrackerDelay{.least_ns = 5 * kMs, .uncertainty_ns = 2 * kMs}};
}

std::array<std::uint8_t, 65> report_at(std::uint64_t time_us) {
    std::array<std::uint8_t, 65> report{0x10};
    std::memcpy(report.data() + 1, &time_us, sizeof(time_us));
    const std::int32_t um[] = {200'000, 100'000, 170'000, 160'000,
                               600'000, 230'000, 160'000, 600'000};
    std::memcpy(report.data() + 9, um, sizeof(um));
    return report;
}

/// Gaze in report 3, one eye after the other in report 4; tenths of a millimetre. `timed`: the gaze
/// with microseconds of 32 bits before it.
std::vector<std::uint8_t> eyes_apart(bool timed = false) {
    using namespace eye_tracker;
    DescriptorItems d;
    d.page(0x12).open(CollectionType::Application, kEyeTracker).logical(-32768, 32767);
    d.unit(0x11).exponent(0x0E);
    d.report_id(3);
    if (timed) {
        d.usage(kSensorTimestamp).fields(32, 1).input(DescriptorItems::kVariable);
    }
    d.open(CollectionType::Logical, kGazePoint);
    d.usage(kPositionX).usage(kPositionY).fields(16, 2).input(DescriptorItems::kVariable).close();
    d.report_id(4);
    for (const Usage eye : {kLeftEyePosition, kRightEyePosition}) {
        d.open(CollectionType::Logical, eye).usage(kPositionX).usage(kPositionY).usage(kPositionZ);
        d.fields(16, 3).input(DescriptorItems::kVariable).close();
    }
    return d.close().bytes();
}

TEST(TrackerSamples, HaveTimesOnceTheClockIsKnownAndTheProfilesDelayBeforeIt) {
    TrackerSamples samples = samples_of(first_layout());
    std::optional<gaze::GazeSample> last;
    for (int i = 0; i < 600; ++i) {
        const std::int64_t taken_ns = i * (10 * kMs);
        // 3 ms at the least, every fifth 2 ms later.
        const std::int64_t arrived_ns = taken_ns + 3 * kMs + (i % 5 == 4 ? 2 * kMs : 0);
        last = samples.take(report_at(static_cast<std::uint64_t>(taken_ns / 1000)), arrived_ns);
        ASSERT_TRUE(last.has_value());
        EXPECT_EQ(last->arrived, (time::Stamp{arrived_ns, time::StampKind::Measured}));
        EXPECT_EQ(last->sampled.known(), last->ready.known());
    }
    ASSERT_TRUE(last->sampled.known());
    EXPECT_EQ(last->sampled.kind, time::StampKind::Profile);
    EXPECT_NEAR(static_cast<double>(last->ready.ns), 5990.0 * kMs + 3.0 * kMs, 1e3);
    EXPECT_EQ(last->ready.ns - last->sampled.ns, 5 * kMs);
    EXPECT_GE(*last->uncertainty_ns, 2 * kMs);
    EXPECT_LT(*last->uncertainty_ns, 3 * kMs);
    EXPECT_EQ(samples.counts().samples, 600U);
}

TEST(TrackerSamples, AreOfUnknownAgeWhereTheTimestampsLie) {
    TrackerSamples samples = samples_of(first_layout());
    for (int i = 0; i < 600; ++i) {
        const std::int64_t arrived_ns = i * (10 * kMs);
        const auto sample =
            samples.take(report_at(static_cast<std::uint64_t>(i / 100)), arrived_ns);
        EXPECT_FALSE(sample->sampled.known());
        EXPECT_FALSE(sample->uncertainty_ns.has_value());
        EXPECT_TRUE(sample->arrived.known());
    }
    const auto change = samples.take_change();
    ASSERT_TRUE(change.has_value());
    EXPECT_EQ(*change,
              "clock: unusable (timestamps stand still), so the age of the gaze is unknown");
    EXPECT_FALSE(samples.take_change().has_value()) << "told once";
}

/// A counter of microseconds in a field of 32 bits, and what its descriptor says of it.
struct CounterCase {
    const char* name;
    std::int32_t least;  ///< logical range
    std::int32_t greatest;
    std::int64_t first;  ///< what the counter runs through in truth
    std::int64_t span;   ///< greatest less least
};

class CountersThatWrap : public testing::TestWithParam<CounterCase> {};

// No sample's age is unknown because of a wrap, also where the eyes were closed meanwhile.
TEST_P(CountersThatWrap, KeepTheAgeOfEverySample) {
    using namespace eye_tracker;
    const CounterCase& counter = GetParam();
    DescriptorItems d;
    d.page(kPage).open(CollectionType::Application, kEyeTracker);
    d.logical(counter.least, counter.greatest).unit(0x1001).exponent(0x0A);
    d.usage(kSensorTimestamp).fields(32, 1).input(DescriptorItems::kVariable);
    d.logical(-32768, 32767).unit(0x11).exponent(0x0E);
    d.usage(kGazePoint).fields(16, 2).input(DescriptorItems::kVariable).close();
    TrackerSamples samples = samples_of(d.bytes());
    constexpr int kSettled = 100;
    constexpr std::int64_t kStep_us = 8'333;
    // The first wrap comes after 300 samples; short ranges wrap again and again.
    std::int64_t truth_us = counter.first + counter.span + 1 - 300 * kStep_us % counter.span;
    std::int64_t arrived_ns = 0;
    std::int64_t last_ns = 0;
    for (int i = 0; i < 2000; ++i) {
        // Twice blinks of up to 0.4 s, once 3.2 s without gaze.
        const std::int64_t periods = i == 280 || i == 800 ? 48 : i == 1200 ? 384 : 1;
        truth_us += periods * kStep_us;
        arrived_ns += periods * kStep_us * 1000;
        const auto shown = static_cast<std::uint32_t>(counter.first + (truth_us - counter.first) %
                                                                          (counter.span + 1));
        std::vector<std::uint8_t> report(8, 1);
        std::memcpy(report.data(), &shown, sizeof(shown));
        const auto sample = samples.take(report, arrived_ns + 2 * kMs + i % 3 * (kMs / 10));
        ASSERT_TRUE(sample.has_value());
        if (i > kSettled) {
            ASSERT_TRUE(sample->sampled.known()) << i;
            ASSERT_EQ(sample->device_ns - last_ns, periods * kStep_us * 1000) << i;
        }
        last_ns = sample->device_ns;
    }
    EXPECT_EQ(samples.clock()->steps(), 0U);
}

constexpr std::int64_t kBits31 = 0x7FFFFFFF;
constexpr std::int64_t kBits32 = 0xFFFFFFFF;
INSTANTIATE_TEST_SUITE_P(
    Kinds, CountersThatWrap,
    testing::Values(CounterCase{"31BitsAsStated", 0, 0x7FFFFFFF, 0, kBits31},
                    CounterCase{"32BitsStatedAs31", 0, 0x7FFFFFFF, 0, kBits32},
                    CounterCase{"32BitsStatedAsMinusOne", 0, -1, 0, kBits32},
                    CounterCase{"32BitsNotStated", 0, 0, 0, kBits32},
                    CounterCase{"32BitsBehindABytesRange", 0, 255, 0, kBits32},
                    CounterCase{"32BitsBehindAPositionsRange", -2'000'000, 2'000'000, 0, kBits32},
                    CounterCase{"Signed", std::numeric_limits<std::int32_t>::min(), 0x7FFFFFFF,
                                std::numeric_limits<std::int32_t>::min(), kBits32},
                    CounterCase{"SignedWithoutItsLeast", -0x7FFFFFFF, 0x7FFFFFFF,
                                std::numeric_limits<std::int32_t>::min(), kBits32},
                    CounterCase{"AMillion", 0, 999'999, 0, 999'999},
                    CounterCase{"AMinute", 0, 59'999'999, 0, 59'999'999},
                    CounterCase{"FromOne", 1, 10'000'000, 1, 9'999'999},
                    CounterCase{"24Bits", 0, 0xFFFFFF, 0, 0xFFFFFF}),
    [](const auto& instance) { return std::string("Of") + instance.param.name; });

// What is known of the clock does not go with it.
TEST(TrackerSamples, KeepTheClockWhenAReportIsCutOffBeforeItsTimestamp) {
    TrackerSamples samples = samples_of(first_layout());
    EXPECT_EQ(samples.clock(), nullptr);
    for (int i = 0; i < 100; ++i) {
        const auto report = report_at(static_cast<std::uint64_t>(i) * 10'000);
        EXPECT_TRUE(samples.take(report, i * (10 * kMs)).has_value());
    }
    const time::ClockFit* const before = samples.clock();
    ASSERT_NE(before, nullptr);
    constexpr std::size_t kCutOff = 5;
    const auto whole = report_at(1'000'000);
    const auto sample = samples.take(std::span(whole).first(kCutOff), 1000 * kMs);
    ASSERT_TRUE(sample.has_value());
    EXPECT_FALSE(sample->sampled.known());
    EXPECT_EQ(samples.clock(), before);
}

TEST(TrackerSamples, TellChangesOfTheStatusOnce) {
    TrackerSamples samples = samples_of(first_layout());
    const std::vector<std::uint8_t> ready{0x13, 1, 120, 0};
    const std::vector<std::uint8_t> uncalibrated{0x13, 4, 120, 0};
    EXPECT_FALSE(samples.take(ready, 1).has_value());
    EXPECT_EQ(samples.take_change(), "status: ready");
    (void)samples.take(ready, 2);
    EXPECT_FALSE(samples.take_change().has_value());
    (void)samples.take(uncalibrated, 3);
    EXPECT_NE(samples.take_change().value_or("").find("calibrat"), std::string::npos);
}

// A tracker without report ids has no report of its own for it.
TEST(TrackerSamples, TellChangesOfAStatusThatComesWithTheGaze) {
    using namespace eye_tracker;
    DescriptorItems d;
    d.page(kPage).open(CollectionType::Application, kEyeTracker);
    d.usage(kConfigurationStatus).fields(8, 1).input(DescriptorItems::kVariable);
    d.usage(kGazePoint).fields(32, 2).input(DescriptorItems::kVariable).close();
    TrackerSamples samples = samples_of(d.bytes());
    std::vector<std::uint8_t> report(9, 0);
    report[0] = 1;
    EXPECT_TRUE(samples.take(report, 1).has_value());
    EXPECT_EQ(samples.take_change(), "status: ready");
    EXPECT_TRUE(samples.take(report, 2).has_value());
    EXPECT_FALSE(samples.take_change().has_value());
    report[0] = 4;
    EXPECT_TRUE(samples.take(report, 3).has_value());
    EXPECT_EQ(samples.status(), TrackerStatus::UserCalibrationNeeded);
    EXPECT_TRUE(samples.take_change().has_value());
    samples.learn({}, TrackerStatus::Ready);
    EXPECT_EQ(samples.status(), TrackerStatus::UserCalibrationNeeded) << "reports are newer";
}

TEST(TrackerSamples, DoNotTellAStatusThatWasToldBefore) {
    TrackerSamples samples(
        value_or_throw(find_eye_tracker(value_or_throw(parse_report_descriptor(first_layout())))),
        {}, {}, TrackerStatus::Ready);
    (void)samples.take(std::vector<std::uint8_t>{0x13, 1, 120, 0}, 1);
    EXPECT_FALSE(samples.take_change().has_value());
    (void)samples.take(std::vector<std::uint8_t>{0x13, 3, 120, 0}, 2);
    EXPECT_TRUE(samples.take_change().has_value());
}

TEST(TrackerSamples, KnowWhetherItWasTrackingThatCame) {
    TrackerSamples samples = samples_of(eyes_apart());
    const std::vector<std::uint8_t> eyes(13, 4);
    (void)samples.take(eyes, 1);
    EXPECT_TRUE(samples.tracked_last()) << "eyes without gaze are";
    (void)samples.take(std::vector<std::uint8_t>{0x77, 1, 2, 3}, 2);
    EXPECT_FALSE(samples.tracked_last());
    TrackerSamples others = samples_of(first_layout());
    (void)others.take(report_at(5), 3);
    EXPECT_TRUE(others.tracked_last());
    (void)others.take(std::vector<std::uint8_t>{0x13, 1, 120, 0}, 4);
    EXPECT_FALSE(others.tracked_last());
}

TEST(TrackerSamples, TakeEyesThatAreReportedApartFromTheGaze) {
    TrackerSamples samples = samples_of(eyes_apart());
    const auto words = [](std::uint8_t id, std::initializer_list<int> values) {
        std::vector<std::uint8_t> report{id};
        for (const int value : values) {
            report.push_back(static_cast<std::uint8_t>(value));
            report.push_back(static_cast<std::uint8_t>(value >> 8));
        }
        return report;
    };
    const auto gaze = words(3, {2000, 1000});
    EXPECT_FALSE(samples.take(gaze, 0)->eyes[0].valid) << "nobody knows yet where the eyes are";
    // 60 mm apart, 600 mm away, their middle in front of the point that is looked at.
    EXPECT_FALSE(samples.take(words(4, {1700, 1000, 6000, 2300, 1000, 6000}), 1).has_value())
        << "where the eyes are is no gaze, and no loss of it either";
    const auto sample = samples.take(gaze, 2);
    ASSERT_TRUE(sample.has_value());
    for (const gaze::Eye eye : gaze::kEyes) {
        const gaze::EyeRay& ray = sample->eyes[gaze::index(eye)];
        ASSERT_TRUE(ray.valid);
        EXPECT_NEAR(ray.direction.x / -ray.direction.z, eye == gaze::Eye::Left ? 0.05 : -0.05,
                    1e-9);
        EXPECT_NEAR(ray.origin_m.x, eye == gaze::Eye::Left ? -0.03 : 0.03, 1e-9);
    }
    EXPECT_FALSE(samples.take(gaze, 2000 * kMs)->eyes[0].valid) << "that was seconds ago";
    EXPECT_EQ(samples.counts().samples, 3U);
    EXPECT_EQ(samples.counts().others, 0U);
    EXPECT_FALSE(geometry_problem(value_or_throw(find_eye_tracker(
                                      value_or_throw(parse_report_descriptor(eyes_apart())))),
                                  {})
                     .has_value());
}

TEST(TrackerSamples, CountALossOnlyBehindAFullBacklog) {
    TrackerSamples samples = samples_of(first_layout());
    std::int64_t taken_ns = 0;
    const auto take = [&](std::int64_t arrived_ns) {
        return samples.take(report_at(static_cast<std::uint64_t>(taken_ns / 1000)), arrived_ns);
    };
    for (int i = 0; i < 100; ++i) {
        taken_ns += 10 * kMs;
        (void)take(taken_ns + kMs);
    }
    taken_ns += 500 * kMs;  // no eyes were seen
    (void)take(taken_ns + kMs);
    EXPECT_EQ(samples.lost_before_last(), 0U);
    // The reader slept for 2 s: 63 reports waited, the 137 after them are gone.
    const std::int64_t awake_ns = taken_ns + 2000 * kMs;
    for (int i = 0; i < 63; ++i) {
        taken_ns += 10 * kMs;
        (void)take(awake_ns + i * std::int64_t{1000});
        EXPECT_EQ(samples.lost_before_last(), 0U);
    }
    taken_ns += 1380 * kMs;
    (void)take(taken_ns + kMs);
    EXPECT_EQ(samples.lost_before_last(), 137U);
    EXPECT_EQ(samples.counts().lost, 137U);
}

// Reports of all ids wait in one queue.
TEST(TrackerSamples, CountALossBehindABacklogOfSeveralIds) {
    TrackerSamples samples = samples_of(eyes_apart(true));
    const auto take_both = [&](std::int64_t taken_ns, std::int64_t arrived_ns) {
        const auto time_us = static_cast<std::uint32_t>(taken_ns / 1000);
        std::vector<std::uint8_t> gaze{3, 0, 0, 0, 0, 1, 0, 1, 0};
        std::memcpy(gaze.data() + 1, &time_us, sizeof(time_us));
        (void)samples.take(std::vector<std::uint8_t>(13, 4), arrived_ns);
        (void)samples.take(gaze, arrived_ns);
    };
    std::int64_t taken_ns = 0;
    for (int i = 0; i < 100; ++i) {
        taken_ns += 10 * kMs;
        take_both(taken_ns, taken_ns + kMs);
    }
    taken_ns += 500 * kMs;  // no eyes were seen
    take_both(taken_ns, taken_ns + kMs);
    EXPECT_EQ(samples.counts().lost, 0U);
    // 62 reports waited, 31 of the gaze; of the next 168, 84 of the gaze, there is none.
    const std::int64_t awake_ns = taken_ns + 1150 * kMs;
    for (int i = 0; i < 31; ++i) {
        taken_ns += 10 * kMs;
        take_both(taken_ns, awake_ns + i * std::int64_t{1000});
    }
    EXPECT_EQ(samples.counts().lost, 0U);
    taken_ns += 850 * kMs;
    take_both(taken_ns, taken_ns + kMs);
    EXPECT_EQ(samples.counts().lost, 84U);
}

TEST(TrackerSamples, WithoutTimestampsOnlyTheArrivalIsKnown) {
    DescriptorItems d;
    d.page(eye_tracker::kPage).open(CollectionType::Application, eye_tracker::kEyeTracker);
    d.usage(eye_tracker::kGazePoint).fields(32, 2).input(DescriptorItems::kVariable).close();
    TrackerSamples samples = samples_of(d.bytes());
    const auto sample = samples.take(std::vector<std::uint8_t>(8, 0), 77);
    ASSERT_TRUE(sample.has_value());
    EXPECT_FALSE(sample->sampled.known());
    EXPECT_EQ(sample->arrived.ns, 77);
    EXPECT_EQ(samples.clock(), nullptr);
}

TEST(TrackerSamples, AllocateNothingInSteadyState) {
    TrackerSamples samples = samples_of(first_layout());
    const auto take = [&](int i) {
        (void)samples.take(report_at(static_cast<std::uint64_t>(i) * 1000), i * kMs);
    };
    for (int i = 0; i < 2000; ++i) {
        take(i);
        (void)samples.take_change();
    }
    const std::size_t before = tests::allocations_of_this_thread();
    for (int i = 2000; i < 4000; ++i) {
        take(i);
        EXPECT_FALSE(samples.take_change().has_value());
    }
    EXPECT_EQ(tests::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace gazeloop::drivers::hid
