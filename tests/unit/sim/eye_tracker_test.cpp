#include "sim/eye_tracker.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <vector>

#include "sim/turned_direction.h"
#include "tests/unit/sim/statistics.h"

namespace gazeloop::sim {
namespace {

using namespace tests;

constexpr HeadTerms kStill{.sway_deg = 0.0, .turn_percent = 0.0};
/// An eye that looks straight ahead for ever, from far away.
constexpr EyeTerms kFixed{.saccade_deg = 0.0,
                          .drift_deg = 0.0,
                          .microsaccades_per_s = 0.0,
                          .blinks_per_min = 0.0,
                          .distance_m = 1000.0};

std::vector<gaze::GazeSample> samples_of(const TrackerTerms& terms, std::uint64_t seed, int count,
                                         const EyeTerms& eye = kFixed,
                                         const HeadTerms& head = kStill) {
    Person person(eye, head, seed);
    EyeTracker tracker(terms, seed, 0);
    std::vector<gaze::GazeSample> samples;
    for (int i = 0; i < count; ++i) {
        if (const auto sample = tracker.step(person)) {
            samples.push_back(*sample);
        }
    }
    return samples;
}

TEST(EyeTracker, ReportsTheTruthWithoutTerms) {
    Person person({}, {}, 4);
    const auto samples = samples_of({.rate_hz = 250.0}, 4, 2000, {}, {});
    ASSERT_EQ(samples.size(), 2000U);
    for (std::size_t i = 0; i < samples.size(); ++i) {
        const gaze::GazeSample& sample = samples[i];
        const TrueGaze truth = person.at(static_cast<double>(i) / 250.0);
        EXPECT_EQ(sample.sequence, i);
        EXPECT_EQ(sample.sampled.ns, static_cast<std::int64_t>(i) * 4'000'000);
        EXPECT_EQ(sample.device_ns, sample.sampled.ns);
        EXPECT_EQ(sample.arrived, sample.sampled);
        EXPECT_EQ(sample.sampled.kind, time::StampKind::Modelled);
        ASSERT_TRUE(sample.head.has_value());
        EXPECT_NEAR(angle_deg(sample.head->orientation * glm::dvec3{0.0, 0.0, -1.0},
                              truth.head.orientation * glm::dvec3{0.0, 0.0, -1.0}),
                    0.0, 1e-6);
        for (std::size_t eye = 0; eye < 2; ++eye) {
            EXPECT_EQ(sample.eyes[eye].valid, truth.eyes[eye].openness >= 0.7);
            if (sample.eyes[eye].valid) {
                EXPECT_NEAR(angle_deg(sample.eyes[eye].direction, truth.eyes[eye].direction), 0.0,
                            1e-6);
            } else {
                EXPECT_EQ(sample.eyes[eye].confidence, 0.0);
            }
        }
    }
}

TEST(EyeTracker, HasNoHeadPoseWhereNoHeadMoves) {
    EXPECT_FALSE(samples_of({}, 1, 1).front().head.has_value());
}

TEST(EyeTracker, AddsNoiseOfTheAskedSize) {
    constexpr int kCount = 20'000;
    std::vector<double> right;
    std::vector<double> up;
    std::vector<double> products;
    double before = 0.0;
    for (const auto& sample : samples_of({.noise_deg = 0.5}, 2, kCount)) {
        const glm::dvec3& d = sample.eyes[0].direction;
        right.push_back(glm::degrees(std::asin(d.x)));
        up.push_back(glm::degrees(std::asin(d.y)));
        products.push_back(right.back() * before);
        before = right.back();
    }
    // Four standard errors: of the SD .5 / sqrt(2 n), of the mean .5 / sqrt(n), of the product of
    // neighbours .25 / sqrt(n).
    const double root = std::sqrt(static_cast<double>(kCount));
    for (const auto& axis : {right, up}) {
        EXPECT_NEAR(standard_deviation(axis), 0.5, 4.0 * 0.5 / (root * std::sqrt(2.0)));
        EXPECT_NEAR(mean(axis), 0.0, 4.0 * 0.5 / root + 0.002);  // half the vergence
    }
    EXPECT_NEAR(mean(products), 0.0, 4.0 * 0.25 / root) << "noise is white";
}

TEST(EyeTracker, IsWorseOffAxisByTheGrowth) {
    // The same seed draws the same errors; at 15 deg they are 1 + 15 * .1 times as large.
    EyeTerms far = kFixed;
    far.ipd_mm = 60'000.0;  // eyes 60 m apart that look at 111.96 m are turned by 15 deg
    far.distance_m = 30.0 / std::tan(glm::radians(15.0));
    const glm::dvec3 truth = turned_direction({0.0, 0.0, -1.0}, glm::radians(15.0), 0.0);
    for (const TrackerTerms& terms : {TrackerTerms{.noise_deg = 0.2, .noise_growth_percent = 10.0},
                                      TrackerTerms{.bias_deg = 0.2, .bias_growth_percent = 10.0}}) {
        const auto ahead = samples_of(terms, 3, 50);
        const auto aside = samples_of(terms, 3, 50, far);
        for (std::size_t i = 0; i < ahead.size(); ++i) {
            const double small = angle_deg(ahead[i].eyes[0].direction, {0.0, 0.0, -1.0});
            const double large = angle_deg(aside[i].eyes[0].direction, truth);
            EXPECT_NEAR(large, 2.5 * small, 0.01);  // straight ahead still converges by .002 deg
        }
    }
}

TEST(EyeTracker, HasABiasWhoseMedianIsTheAskedOne) {
    std::vector<double> errors;
    for (std::uint64_t seed = 0; seed < 2000; ++seed) {
        const auto samples = samples_of({.bias_deg = 0.4}, seed, 2);
        errors.push_back(angle_deg(samples[0].eyes[0].direction, {0.0, 0.0, -1.0}));
        EXPECT_EQ(samples[0].eyes[0].direction, samples[1].eyes[0].direction) << "constant";
        EXPECT_NE(samples[0].eyes[0].direction, samples[0].eyes[1].direction) << "per eye";
    }
    // A median's standard error is 1 / (2 f sqrt(n)); the Rayleigh density at its median m is
    // ln(2) / m, so .0065 here.
    EXPECT_NEAR(median(errors), 0.4, 4.0 * 0.0065);
    EXPECT_NEAR(quantile(errors, 0.95) / median(errors), 2.08, 0.15);
}

TEST(EyeTracker, ArrivesLateAndInOrder) {
    const auto samples =
        samples_of({.rate_hz = 1000.0, .delay_ms = 15.0, .jitter_ms = 2.0}, 5, 20'000);
    std::int64_t before_ns = 0;
    std::vector<double> late_ms;
    for (const auto& sample : samples) {
        EXPECT_GE(sample.arrived.ns, before_ns);
        before_ns = sample.arrived.ns;
        late_ms.push_back(static_cast<double>(sample.arrived.ns - sample.sampled.ns) * 1e-6 - 15.0);
        EXPECT_GE(late_ms.back(), 0.0);
    }
    EXPECT_GT(quantile(late_ms, 1.0), 8.0);
    // Alone, without others to wait for: exponential.
    std::vector<double> alone_ms;
    for (const auto& sample : samples_of({.rate_hz = 1.0, .jitter_ms = 2.0}, 5, 20'000)) {
        alone_ms.push_back(static_cast<double>(sample.arrived.ns - sample.sampled.ns) * 1e-6);
    }
    EXPECT_NEAR(mean(alone_ms), 2.0, 4.0 * 2.0 / std::sqrt(20'000.0));
    EXPECT_NEAR(median(alone_ms), 2.0 * std::log(2.0), 4.0 * 2.0 / std::sqrt(20'000.0));
}

TEST(EyeTracker, DropsTheAskedShareInGaps) {
    constexpr int kCount = 100'000;
    const auto samples =
        samples_of({.rate_hz = 100.0, .dropout_percent = 10.0, .dropout_ms = 100.0}, 6, kCount);
    std::vector<double> gaps;
    for (std::size_t i = 1; i < samples.size(); ++i) {
        const auto missing = samples[i].sequence - samples[i - 1].sequence - 1;
        if (missing > 0) {
            gaps.push_back(static_cast<double>(missing));
        }
    }
    // About 1000 gaps of 10 samples on average, SD 9.5: the share's standard error is about
    // sqrt(2 * 10 * .1 / n) = .0045.
    EXPECT_NEAR(1.0 - static_cast<double>(samples.size()) / kCount, 0.1, 4.0 * 0.0045);
    EXPECT_NEAR(mean(gaps), 10.0, 4.0 * 9.5 / std::sqrt(1000.0));
}

TEST(EyeTracker, DropsNothingOrEverything) {
    EXPECT_EQ(samples_of({.dropout_percent = 0.0}, 7, 1000).size(), 1000U);
    EXPECT_TRUE(samples_of({.dropout_percent = 100.0}, 7, 1000).empty());
    // Independent losses, where no length of gaps is asked for.
    EXPECT_NEAR(static_cast<double>(samples_of({.dropout_percent = 50.0}, 7, 10'000).size()),
                5000.0, 4.0 * 50.0);
    EXPECT_NEAR(static_cast<double>(samples_of({.dropout_percent = 99.0}, 7, 10'000).size()), 100.0,
                4.0 * 10.0);
}

TEST(EyeTracker, LosesEachEyeByItself) {
    int left = 0;
    int both = 0;
    for (const auto& sample : samples_of({.eye_loss_percent = 20.0}, 8, 20'000)) {
        left += sample.eyes[0].valid ? 0 : 1;
        both += sample.eyes[0].valid || sample.eyes[1].valid ? 0 : 1;
        if (!sample.eyes[0].valid) {
            EXPECT_EQ(sample.eyes[0].openness, -1.0);
            EXPECT_EQ(sample.eyes[0].confidence, 0.0);
        }
    }
    EXPECT_NEAR(left, 4000, 4 * 57);
    EXPECT_NEAR(both, 800, 4 * 28);
}

TEST(EyeTracker, RoundsDirectionsToItsStep) {
    for (const auto& sample : samples_of({.noise_deg = 1.0, .quantum_deg = 0.25}, 9, 500)) {
        const glm::dvec3& d = sample.eyes[0].direction;
        for (const double angle :
             {glm::degrees(std::atan2(d.x, -d.z)), glm::degrees(std::asin(d.y))}) {
            EXPECT_NEAR(std::remainder(angle, 0.25), 0.0, 1e-9);
        }
        EXPECT_NEAR(glm::length(d), 1.0, 1e-12);
    }
}

TEST(EyeTracker, GainsOnTheHostsClock) {
    const auto samples = samples_of({.rate_hz = 100.0, .clock_ppm = 100.0}, 10, 100'001);
    // After 1000 s of its own it has gained 100 ms.
    EXPECT_EQ(samples.back().device_ns, 1'000'000'000'000);
    EXPECT_NEAR(static_cast<double>(samples.back().device_ns - samples.back().sampled.ns), 99.99e6,
                1e3);
}

TEST(EyeTracker, KeepsEveryOtherTermsNumbers) {
    const TrackerTerms noisy{.jitter_ms = 1.0, .bias_deg = 0.3, .noise_deg = 0.2};
    TrackerTerms all = noisy;
    all.delay_ms = 100.0;
    all.dropout_percent = 30.0;
    all.eye_loss_percent = 20.0;
    const auto some = samples_of(noisy, 11, 2000, {}, {});
    for (const auto& sample : samples_of(all, 11, 2000, {}, {})) {
        const auto& same = some[sample.sequence];
        EXPECT_EQ(sample.sampled, same.sampled);
        for (std::size_t eye = 0; eye < 2; ++eye) {
            if (sample.eyes[eye].valid) {
                EXPECT_EQ(sample.eyes[eye].direction, same.eyes[eye].direction);
            }
        }
    }
}

TEST(EyeTracker, EndsWhereHostTimeEnds) {
    constexpr auto kEnd = std::numeric_limits<std::int64_t>::max();
    Person person(kFixed, kStill, 1);
    EyeTracker tracker({.rate_hz = 10.0, .delay_ms = 1000.0, .jitter_ms = 100.0}, 1,
                       kEnd - 3'000'000'000);
    std::int64_t before_ns = 0;
    int count = 0;
    while (!tracker.finished()) {
        const auto sample = tracker.step(person);
        ASSERT_TRUE(sample.has_value());
        EXPECT_GE(sample->arrived.ns, std::max(before_ns, sample->sampled.ns));
        before_ns = sample->arrived.ns;
        ++count;
    }
    EXPECT_EQ(count, 21);  // 2 s before the last that can still arrive
    EXPECT_TRUE(EyeTracker({.delay_ms = 1000.0}, 1, kEnd - 1).finished());
    EXPECT_FALSE(EyeTracker({}, 1, std::numeric_limits<std::int64_t>::min()).finished());
}

}  // namespace
}  // namespace gazeloop::sim
