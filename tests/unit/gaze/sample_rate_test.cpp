#include "runtime/gaze/sample_rate.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace gazeloop::gaze {
namespace {

constexpr std::int64_t kMs = 1'000'000;

std::vector<GazeSample> at(const std::vector<std::int64_t>& times_ns) {
    std::vector<GazeSample> samples(times_ns.size());
    for (std::size_t i = 0; i < samples.size(); ++i) {
        samples[i].sequence = i;
        samples[i].sampled = {times_ns[i], time::StampKind::Modelled};
    }
    return samples;
}

TEST(SampleRate, IsThatOfTheMeanInterval) {
    // 120 Hz by a clock of whole milliseconds: 8, 8, 9.
    std::vector<std::int64_t> times_ns;
    for (std::int64_t i = 0; i < 1'201; ++i) {
        times_ns.push_back(i * 25 / 3 * kMs);
    }
    EXPECT_NEAR(sample_rate_hz(at(times_ns)), 120.0, 1e-9);
    EXPECT_EQ(sample_rate_hz({}), 0.0);
    EXPECT_EQ(sample_rate_hz(at({5})), 0.0);
}

TEST(SampleRate, LeavesGapsAndLossesOut) {
    std::vector<std::int64_t> times_ns;
    for (std::int64_t i = 0; i < 1'000; ++i) {
        times_ns.push_back(i * 10 * kMs + (i > 500 ? 3'000 * kMs : 0));
    }
    EXPECT_NEAR(sample_rate_hz(at(times_ns)), 100.0, 1e-9);
    std::erase_if(times_ns, [](std::int64_t ns) { return ns / (10 * kMs) % 13 == 5; });
    EXPECT_NEAR(sample_rate_hz(at(times_ns)), 100.0, 1e-9);
}

TEST(SampleRate, IsRightWhereTimesJitter) {
    std::mt19937 random(5);
    std::normal_distribution<double> jitter_ms(0.0, 5.0);
    std::vector<std::int64_t> times_ns;
    for (std::int64_t i = 0; i < 5'000; ++i) {
        times_ns.push_back(i * 10 * kMs + std::llround(jitter_ms(random) * 1e6));
    }
    std::sort(times_ns.begin(), times_ns.end());
    std::vector<GazeSample> samples = at(times_ns);
    EXPECT_NEAR(sample_rate_hz(samples), 100.0, 0.1);
    // A tenth lost, as its numbers tell.
    std::erase_if(samples, [](const GazeSample& sample) { return sample.sequence % 10 == 3; });
    EXPECT_NEAR(sample_rate_hz(samples), 100.0, 0.1);
}

TEST(SampleRate, DoesNotCountByNumbersThatDoNotCountByOne) {
    std::vector<GazeSample> samples = at({0, 10 * kMs, 20 * kMs, 30 * kMs, 40 * kMs});
    for (GazeSample& sample : samples) {
        sample.sequence *= 1'000;
    }
    EXPECT_NEAR(sample_rate_hz(samples), 100.0, 1e-9);
    samples[2].sampled = {};
    EXPECT_NEAR(sample_rate_hz(SampleRange(samples).part(0, 2)), 100.0, 1e-9);
}

}  // namespace
}  // namespace gazeloop::gaze
