#include "runtime/gaze/gaze_quality.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>
#include <random>
#include <vector>

#include "runtime/gaze/sample_rate.h"

namespace gazeloop::gaze {
namespace {

GazeQuality gaze_quality(const SampleRange& samples) {
    return gaze::gaze_quality(samples, sample_rate_hz(samples));
}

/// The left eye looks at `right_deg` to the right; it is not seen where that is NaN.
GazeSample sample(double time_ms, double right_deg) {
    GazeSample made;
    made.sampled = {std::llround(time_ms * 1e6), time::StampKind::Modelled};
    made.eyes[0].valid = !std::isnan(right_deg);
    if (made.eyes[0].valid) {
        const double angle_rad = glm::radians(right_deg);
        made.eyes[0].direction = {std::sin(angle_rad), 0.0, -std::cos(angle_rad)};
    }
    return made;
}

TEST(GazeQuality, SaysHowEvenlySamplesCome) {
    std::vector<GazeSample> samples;
    for (int i = 0; i < 101; ++i) {
        if (i % 10 != 5) {
            samples.push_back(sample(10.0 * i, 1.0));
        }
    }
    const GazeQuality quality = gaze_quality(samples);
    EXPECT_DOUBLE_EQ(quality.duration_s, 1.0);
    EXPECT_DOUBLE_EQ(quality.intervals->median_ms, 10.0);
    EXPECT_DOUBLE_EQ(quality.intervals->p05_ms, 10.0);
    EXPECT_DOUBLE_EQ(quality.intervals->p95_ms, 20.0);
    EXPECT_NEAR(quality.intervals->missing_percent, 10.0, 0.2) << "10 of 100 steps";
}

TEST(GazeQuality, TellsLossesThatLastAsLongAsBlinks) {
    const double lost = std::nan("");
    std::vector<GazeSample> samples;
    for (int i = 0; i < 400; ++i) {
        // 10 ms apart: lost for 20, 200 and 1000 ms between seen samples, and at both ends.
        const bool gone =
            i == 0 || i == 50 || (i >= 100 && i < 119) || (i >= 200 && i < 299) || i == 399;
        samples.push_back(sample(10.0 * i, gone ? lost : 0.0));
    }
    const Losses losses = *gaze_quality(samples).losses;
    EXPECT_EQ(losses.count, 3U) << "the ends are no losses between samples";
    EXPECT_DOUBLE_EQ(losses.median_ms, 200.0);
    EXPECT_DOUBLE_EQ(losses.longest_ms, 1000.0);
    EXPECT_EQ(losses.as_blinks, 1U);
    EXPECT_NEAR(losses.percent, 100.0 * 1220.0 / 3990.0, 1e-9);
}

/// White noise of a known size, in half of the time; a saccade every 100 ms in the other half.
TEST(GazeQuality, MeasuresNoiseWhereTheEyeRests) {
    constexpr double kNoise_deg = 0.1;
    std::mt19937_64 random(3);
    std::normal_distribution<double> noise(0.0, kNoise_deg);
    std::vector<GazeSample> samples;
    for (int i = 0; i < 40'000; ++i) {
        const double saccades = i < 20'000 ? 0.0 : 5.0 * ((i / 50) % 2);
        samples.push_back(sample(2.0 * i, saccades + noise(random)));
    }
    const auto precision = gaze_quality(samples).precision[0];
    ASSERT_TRUE(precision);
    EXPECT_FALSE(gaze_quality(samples).precision[1]) << "never seen";
    EXPECT_NEAR(static_cast<double>(precision->windows), 400.0, 4.0);
    EXPECT_NEAR(precision->deviation_deg, kNoise_deg, 0.003);
    EXPECT_NEAR(precision->sample_to_sample_deg, kNoise_deg * std::sqrt(2.0), 0.005);
    EXPECT_NEAR(precision->step_per_deviation, std::sqrt(2.0), 0.04);
}

TEST(GazeQuality, KnowsSmoothedNoiseByItsSmallSteps) {
    std::mt19937_64 random(4);
    std::normal_distribution<double> noise(0.0, 0.1);
    std::vector<GazeSample> samples;
    double smoothed = 0.0;
    for (int i = 0; i < 20'000; ++i) {
        smoothed += 0.1 * (noise(random) - smoothed);
        samples.push_back(sample(2.0 * i, smoothed));
    }
    EXPECT_LT(gaze_quality(samples).precision[0]->step_per_deviation, 0.7);
}

/// Steps of 4 and 8 ms in turns, as some exports have them.
TEST(GazeQuality, LooksAtUnevenSamples) {
    std::vector<GazeSample> samples;
    for (int i = 0; i < 1000; ++i) {
        samples.push_back(sample(12.0 * (i / 2) + 4.0 * (i % 2), 0.01 * (i % 2)));
    }
    ASSERT_TRUE(gaze_quality(samples).precision[0]);
    EXPECT_NEAR(gaze_quality(samples).precision[0]->sample_to_sample_deg, 0.01, 1e-6);
}

/// A head that turns to the left at 20 deg/s, and an eye that stays on a point in the world.
TEST(GazeQuality, KnowsAnEyeThatRestsInTheWorld) {
    std::vector<GazeSample> samples;
    for (int i = 0; i < 1000; ++i) {
        const double head_deg = 0.04 * i;
        samples.push_back(sample(2.0 * i, head_deg));
        samples.back().head = Pose{
            glm::angleAxis(glm::radians(head_deg), glm::dvec3{0.0, 1.0, 0.0}), glm::dvec3{0.0}};
    }
    EXPECT_LT(gaze_quality(samples).precision[0]->deviation_deg, 1e-6);
    for (GazeSample& sample : samples) {
        sample.head.reset();
    }
    EXPECT_GT(gaze_quality(samples).precision[0]->deviation_deg, 1.0);
}

TEST(GazeQuality, IsSafeWithLittle) {
    EXPECT_FALSE(gaze_quality({}).intervals);
    std::vector<GazeSample> samples{sample(0.0, 0.0)};
    EXPECT_FALSE(gaze_quality(samples).losses);
    samples.emplace_back();  // a time that nobody knows
    samples.push_back(sample(-5.0, 0.0));
    EXPECT_FALSE(gaze_quality(samples).intervals);
    samples.push_back(sample(5.0, std::nan("")));
    const GazeQuality quality = gaze_quality(samples);
    EXPECT_EQ(quality.losses->count, 0U);
    EXPECT_FALSE(quality.precision[0]);
}

}  // namespace
}  // namespace gazeloop::gaze
