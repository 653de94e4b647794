#include "runtime/gaze/smoothing.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdint>
#include <deque>
#include <glm/geometric.hpp>
#include <limits>
#include <string>
#include <vector>

#include "sim/gaze_generator.h"
#include "tests/support/allocation_counter.h"

namespace gazeloop::gaze {
namespace {

enum class Filter { None, Exponential, MovingAverage };

/// A minute of a person who looks around, turns the head and blinks.
std::vector<GazeSample> simulated(double rate_hz, std::uint64_t seed, double noise_deg = 0.14) {
    sim::GazeSimulation simulation{.seed = seed};
    simulation.tracker.rate_hz = rate_hz;
    simulation.tracker.noise_deg = noise_deg;
    return sim::generate_gaze(simulation, 60.0).samples;
}

/// As a runtime would smooth it that starts over after a loss.
void smooth(std::vector<GazeSample>& samples, Filter filter, double rate_hz, double ms) {
    const double kept = std::exp(-1e3 / rate_hz / ms);
    const auto length = static_cast<std::size_t>(std::lround(ms * 1e-3 * rate_hz));
    for (const Eye eye : kEyes) {
        std::deque<glm::dvec3> last;
        for (GazeSample& sample : samples) {
            EyeRay& ray = sample.eyes[index(eye)];
            if (!ray.valid) {
                last.clear();
                continue;
            }
            if (filter == Filter::Exponential) {
                const glm::dvec3 before = last.empty() ? ray.direction : last.back();
                ray.direction = glm::normalize(kept * before + (1.0 - kept) * ray.direction);
                last.assign(1, ray.direction);
            } else if (filter == Filter::MovingAverage) {
                last.push_back(ray.direction);
                if (last.size() > length) {
                    last.pop_front();
                }
                glm::dvec3 sum{0.0};
                for (const glm::dvec3& one : last) {
                    sum += one;
                }
                ray.direction = glm::normalize(sum);
            }
        }
    }
}

SmoothingFinding finding_of(const std::vector<GazeSample>& samples) {
    GazeSmoothing smoothing;
    for (const GazeSample& sample : samples) {
        smoothing.add(sample);
    }
    return smoothing.finding();
}

constexpr std::array kRates{90.0, 120.0, 200.0, 500.0};
constexpr std::uint64_t kSeeds = 3;

TEST(GazeSmoothing, RaisesNoFalseAlarm) {
    for (const double rate_hz : kRates) {
        for (const double noise_deg : {0.0, 0.14, 0.3, 0.6}) {
            for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
                const SmoothingFinding found = finding_of(simulated(rate_hz, seed, noise_deg));
                if (noise_deg == 0.6 && rate_hz == 120.0) {
                    // Between two samples the noise is as fast as saccades, and a speed has three.
                    EXPECT_EQ(found.verdict, SmoothingVerdict::TooFewSaccades);
                    continue;
                }
                EXPECT_EQ(found.verdict, SmoothingVerdict::NotSmoothed)
                    << rate_hz << " Hz, noise " << noise_deg << " deg, seed " << seed;
                EXPECT_NEAR(found.speed.value_or(0.0), 1.0, 0.06);
                EXPECT_LT(found.speed_low, 1.03);
                EXPECT_GT(found.speed_high, 0.97);
                EXPECT_NEAR(found.rate_hz, rate_hz, 1e-3 * rate_hz);
                EXPECT_FALSE(found.time_constant_ms.has_value());
                EXPECT_TRUE(found.in_world);
            }
        }
    }
}

struct FilterCase {
    Filter filter;
    double ms;
    double speed_least;  ///< over all rates
    double speed_most;
    bool always_found;
    bool never_found;
};

// Found of 12 minutes each (4 rates, 3 seeds), all or none, as the header states; exponential
// filters of 10 ms lie on the border.
TEST(GazeSmoothing, FindsFiltersByTheirStrength) {
    for (const FilterCase& one : {FilterCase{Filter::Exponential, 5.0, 0.88, 0.99, false, true},
                                  {Filter::Exponential, 10.0, 0.75, 0.89, false, false},
                                  {Filter::Exponential, 20.0, 0.56, 0.72, true, false},
                                  {Filter::Exponential, 50.0, 0.30, 0.46, true, false},
                                  {Filter::MovingAverage, 20.0, 0.80, 0.96, false, true},
                                  {Filter::MovingAverage, 30.0, 0.66, 0.80, true, false},
                                  {Filter::MovingAverage, 50.0, 0.42, 0.60, true, false},
                                  {Filter::MovingAverage, 100.0, 0.20, 0.35, true, false}}) {
        int smoothed = 0;
        int cases = 0;
        for (const double rate_hz : kRates) {
            for (std::uint64_t seed = 1; seed <= kSeeds; ++seed) {
                std::vector<GazeSample> samples = simulated(rate_hz, seed);
                smooth(samples, one.filter, rate_hz, one.ms);
                const SmoothingFinding found = finding_of(samples);
                EXPECT_GE(found.speed.value_or(0.0), one.speed_least) << one.ms << " " << rate_hz;
                EXPECT_LE(found.speed.value_or(9.0), one.speed_most) << one.ms << " " << rate_hz;
                smoothed += found.verdict == SmoothingVerdict::Smoothed ? 1 : 0;
                ++cases;
                if (one.filter == Filter::Exponential && one.ms == 20.0) {
                    EXPECT_NEAR(found.time_constant_ms.value_or(0.0), 20.0, 3.0);
                }
                if (one.ms >= 50.0 && one.filter == Filter::Exponential) {
                    EXPECT_EQ(found.time_constant_ms, GazeSmoothing::kLongestTimeConstant_ms);
                }
            }
        }
        if (one.always_found) {
            EXPECT_EQ(smoothed, cases) << one.ms;
        }
        if (one.never_found) {
            EXPECT_EQ(smoothed, 0) << one.ms;
        }
    }
}

TEST(GazeSmoothing, IsNotMisledByATrackersFaults) {
    sim::GazeSimulation simulation{.seed = 4};
    simulation.eye.pursuit_percent = 20.0;
    simulation.tracker = {.rate_hz = 200.0,
                          .delay_ms = 10.0,
                          .jitter_ms = 0.5,
                          .bias_deg = 1.0,
                          .bias_growth_percent = 5.0,
                          .noise_deg = 0.14,
                          .noise_growth_percent = 3.0,
                          .quantum_deg = 0.05,
                          .dropout_percent = 2.0,
                          .eye_loss_percent = 3.0,
                          .dropout_ms = 50.0,
                          .clock_ppm = 100.0};
    EXPECT_EQ(finding_of(sim::generate_gaze(simulation, 120.0).samples).verdict,
              SmoothingVerdict::NotSmoothed);
}

TEST(GazeSmoothing, SaysSoWhereHeadPosesAreUnknown) {
    std::vector<GazeSample> samples = simulated(200.0, 1);
    for (GazeSample& sample : samples) {
        sample.head.reset();
    }
    EXPECT_FALSE(finding_of(samples).in_world);
}

TEST(GazeSmoothing, TakesOneEyeWhereThereIsOne) {
    std::vector<GazeSample> samples = simulated(200.0, 1);
    for (GazeSample& sample : samples) {
        sample.eyes[0].valid = false;
    }
    EXPECT_EQ(finding_of(samples).verdict, SmoothingVerdict::NotSmoothed);
}

TEST(GazeSmoothing, SaysWhyItCannotBeKnown) {
    EXPECT_EQ(GazeSmoothing().finding().verdict, SmoothingVerdict::NoSamples);

    std::vector<GazeSample> samples = simulated(120.0, 1);
    EXPECT_EQ(finding_of({samples.begin(), samples.begin() + 1}).verdict,
              SmoothingVerdict::TooFewSaccades);
    EXPECT_EQ(finding_of({samples.begin(), samples.begin() + 600}).verdict,
              SmoothingVerdict::TooFewSaccades);

    const SmoothingFinding slow = finding_of(simulated(60.0, 1));
    EXPECT_EQ(slow.verdict, SmoothingVerdict::TooSlow);
    EXPECT_NEAR(slow.rate_hz, 60.0, 0.1);

    std::vector<GazeSample> standing = samples;
    for (GazeSample& sample : standing) {
        sample.eyes = samples.front().eyes;
        sample.head.reset();
    }
    EXPECT_EQ(finding_of(standing).verdict, SmoothingVerdict::Repeated);

    for (GazeSample& sample : samples) {
        sample.sampled = {};
    }
    EXPECT_EQ(finding_of(samples).verdict, SmoothingVerdict::NoTimes);
}

TEST(GazeSmoothing, IsUnmovedByAbsurdSamples) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInf = std::numeric_limits<double>::infinity();
    std::vector<GazeSample> samples = simulated(200.0, 2);
    std::vector<GazeSample> with;
    std::size_t place = 0;
    for (const GazeSample& sample : samples) {
        with.push_back(sample);
        if (++place % 400 != 0) {
            continue;
        }
        GazeSample odd = sample;
        odd.sampled.ns += 1;
        switch (place / 400 % 5) {
            case 0:
                odd.eyes[0].direction = {kNan, 0.0, 0.0};
                break;
            case 1:
                odd.eyes[1].direction = {0.0, kInf, 0.0};
                break;
            case 2:
                odd.eyes[0].direction = odd.eyes[1].direction = {0.0, 0.0, 0.0};
                break;
            case 3:
                odd.head = Pose{.orientation = {kNan, 0.0, 0.0, 0.0}, .position_m = {}};
                break;
            default:
                odd.sampled.ns = std::numeric_limits<std::int64_t>::min();
                break;
        }
        with.push_back(odd);
    }
    const SmoothingFinding found = finding_of(with);
    EXPECT_EQ(found.verdict, SmoothingVerdict::NotSmoothed);
    EXPECT_NEAR(found.speed.value_or(0.0), 1.0, 0.08);
}

TEST(GazeSmoothing, StopsAtSoManySaccadesAndSaysSo) {
    const std::vector<GazeSample> minute = simulated(90.0, 3, 0.0);
    GazeSmoothing smoothing;
    for (std::int64_t i = 0; i < 30; ++i) {
        for (GazeSample sample : minute) {
            sample.sampled.ns += i * 60'000'000'000;
            smoothing.add(sample);
        }
    }
    const SmoothingFinding found = smoothing.finding();
    EXPECT_TRUE(found.stopped);
    EXPECT_LE(found.saccades, GazeSmoothing::kMostSaccades);
    EXPECT_GT(found.looked_at_s, 60.0);
    EXPECT_LT(found.looked_at_s, 1800.0);
}

TEST(GazeSmoothing, SaysTheSameOfTheSameSamples) {
    const std::vector<GazeSample> samples = simulated(120.0, 5);
    const SmoothingFinding first = finding_of(samples);
    const SmoothingFinding second = finding_of(samples);
    EXPECT_EQ(first.speed, second.speed);
    EXPECT_EQ(first.speed_low, second.speed_low);
    EXPECT_EQ(first.speed_high, second.speed_high);
}

TEST(GazeSmoothing, AllocatesNothingWhileSamplesPass) {
    const std::vector<GazeSample> samples = simulated(120.0, 6);
    GazeSmoothing smoothing;
    const std::size_t before = gazeloop::tests::allocations_of_this_thread();
    for (const GazeSample& sample : samples) {
        smoothing.add(sample);
    }
    EXPECT_EQ(gazeloop::tests::allocations_of_this_thread(), before);
}

}  // namespace
}  // namespace gazeloop::gaze
