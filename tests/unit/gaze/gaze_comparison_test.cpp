#include "runtime/gaze/gaze_comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <random>
#include <vector>

namespace gazeloop::gaze {
namespace {

/// Where the eyes look at a time: steps to new places every 300 ms, over 40 ms each.
struct Look {
    double right_deg;
    double up_deg;
};

Look look_at(double time_ms) {
    const auto place = [](int step) {
        return Look{12.0 * std::sin(1.7 * step), 8.0 * std::sin(2.9 * step + 1.0)};
    };
    const int step = static_cast<int>(std::floor(time_ms / 300.0));
    const double share = std::clamp((time_ms - 300.0 * step) / 40.0, 0.0, 1.0);
    const Look from = place(step - 1);
    const Look to = place(step);
    return {std::lerp(from.right_deg, to.right_deg, share),
            std::lerp(from.up_deg, to.up_deg, share)};
}

struct Recorder {
    double step_ms = 4.0;
    double late_ms = 0.0;
    double gain = 1.0;
    double offset_deg = 0.0;  ///< right, and down
    double noise_deg = 0.05;
    double duration_ms = 60'000.0;
};

std::vector<GazeSample> recorded(const Recorder& by) {
    std::mt19937_64 random(static_cast<std::uint64_t>(by.late_ms * 7.0 + by.step_ms));
    std::normal_distribution<double> noise(0.0, by.noise_deg);
    std::vector<GazeSample> samples;
    for (double t = 0.0; t < by.duration_ms; t += by.step_ms) {
        GazeSample& sample = samples.emplace_back();
        sample.sampled = {std::llround((5e3 + t) * 1e6), time::StampKind::Modelled};
        const Look look = look_at(1e4 + t - by.late_ms);
        const double right = glm::radians(by.gain * look.right_deg + by.offset_deg + noise(random));
        const double up = glm::radians(by.gain * look.up_deg - by.offset_deg + noise(random));
        sample.eyes[1].valid = std::fmod(t, 7000.0) > 150.0;  // blinks
        sample.eyes[1].direction = {std::cos(up) * std::sin(right), std::sin(up),
                                    -std::cos(up) * std::cos(right)};
    }
    return samples;
}

TEST(GazeComparison, FindsLagGainAndOffset) {
    const GazeComparison found = value_or_throw(compare_gaze(
        recorded({}), recorded({.step_ms = 8.3, .late_ms = 37.0, .gain = 0.9, .offset_deg = 1.5})));
    EXPECT_DOUBLE_EQ(found.step_ms, 4.0);
    EXPECT_NEAR(found.lag_ms, 37.0, 1.0);
    ASSERT_TRUE(found.lag_interval_ms);
    EXPECT_LE((*found.lag_interval_ms)[0], found.lag_ms);
    EXPECT_GE((*found.lag_interval_ms)[1], found.lag_ms);
    EXPECT_LT((*found.lag_interval_ms)[1] - (*found.lag_interval_ms)[0], 4.0);
    EXPECT_NEAR(found.azimuth.gain, 0.9, 0.005);
    EXPECT_NEAR(found.azimuth.offset_deg, 1.5, 0.05);
    EXPECT_NEAR(found.elevation.gain, 0.9, 0.01);
    EXPECT_NEAR(found.elevation.offset_deg, -1.5, 0.05);
    EXPECT_LT(found.azimuth.residual_deg, 0.5);
    EXPECT_GT(found.correlation, 0.9);
    EXPECT_FALSE(found.doubtful());
    EXPECT_GT(found.overlap_s, 50.0);
}

TEST(GazeComparison, IsTheOtherWayRoundWithTheOtherSign) {
    const auto early = recorded({.duration_ms = 20'000.0});
    const auto late = recorded({.late_ms = 250.0, .duration_ms = 20'000.0});
    EXPECT_NEAR(value_or_throw(compare_gaze(early, late)).lag_ms, 250.0, 1.0);
    EXPECT_NEAR(value_or_throw(compare_gaze(late, early)).lag_ms, -250.0, 1.0);
    EXPECT_NEAR(value_or_throw(compare_gaze(early, early)).lag_ms, 0.0, 1e-9);
}

TEST(GazeComparison, GivesNoIntervalForAFewSeconds) {
    const auto some = recorded({.duration_ms = 6'000.0});
    EXPECT_FALSE(value_or_throw(compare_gaze(some, some)).lag_interval_ms);
}

/// Other eyes: some lag correlates most, which means nothing.
TEST(GazeComparison, DoubtsWhatHardlyAgrees) {
    auto others = recorded({.duration_ms = 20'000.0});
    std::mt19937_64 random(9);
    std::vector<glm::dvec3> places;
    for (std::size_t i = 0; i < others.size(); ++i) {
        if (i % 90 == 0) {
            const double right = std::uniform_real_distribution<double>(-0.2, 0.2)(random);
            const double up = std::uniform_real_distribution<double>(-0.15, 0.15)(random);
            places.push_back(glm::normalize(glm::dvec3{right, up, -1.0}));
        }
        others[i].eyes[1].direction = places.back();
    }
    const auto found = compare_gaze(recorded({.duration_ms = 20'000.0}), others);
    ASSERT_TRUE(found);
    EXPECT_TRUE(found->doubtful()) << found->correlation;
}

TEST(GazeComparison, RefusesWhatHasNothingInCommon) {
    EXPECT_FALSE(compare_gaze({}, {}));
    const auto brief = recorded({.duration_ms = 1'000.0});
    EXPECT_FALSE(compare_gaze(brief, brief)) << "less than 2 s";
    auto still = recorded({.noise_deg = 0.0});
    for (GazeSample& sample : still) {
        sample.eyes[1].direction = {0.0, 0.0, -1.0};
    }
    EXPECT_FALSE(compare_gaze(still, recorded({})));
    auto unseen = recorded({});
    for (GazeSample& sample : unseen) {
        sample.eyes[1].valid = false;
    }
    EXPECT_FALSE(compare_gaze(unseen, recorded({})));
}

}  // namespace
}  // namespace gazeloop::gaze
