#include "runtime/statistics/psychometric_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace gazeloop::statistics {
namespace {

std::vector<LevelCount> exact_counts(const PsychometricFunction& truth, std::uint32_t trials) {
    std::vector<LevelCount> counts;
    for (double x = -1.0; x <= 1.0; x += 0.1) {
        counts.push_back(
            {x, trials, static_cast<std::uint32_t>(std::lround(truth.at(x) * trials))});
    }
    return counts;
}

TEST(PsychometricFit, FindsTheFunctionThatManyAnswersShow) {
    for (const bool rising : {true, false}) {
        const PsychometricFunction truth{
            .rising = rising, .threshold = 0.2, .spread = 0.3, .lowest = 0.03, .highest = 0.01};
        const std::vector<std::vector<LevelCount>> one{exact_counts(truth, 100'000)};
        const FittedPeople found = fit_people(one, {.rising = rising});
        EXPECT_NEAR(found.function.threshold, truth.threshold, 2e-3);
        EXPECT_NEAR(found.function.spread, truth.spread, 5e-3);
        EXPECT_NEAR(found.function.lowest, truth.lowest, 5e-3);
        EXPECT_NEAR(found.function.highest, truth.highest, 5e-3);
        EXPECT_NEAR(found.together().x_where(0.8), truth.x_where(0.8), 5e-3);
        EXPECT_NEAR(truth.at(truth.threshold), 0.03 + 0.96 * 0.5, 1e-12);
    }
}

TEST(PsychometricFit, IsFiniteWhereAnswersSayNothing) {
    const auto fit = [](std::vector<LevelCount> counts, bool adaptive = false) {
        const std::vector<std::vector<LevelCount>> one{std::move(counts)};
        return fit_threshold(one, {.adaptive = adaptive, .resamples = 50});
    };
    for (const FittedThreshold& found :
         {fit({{1.0, 1, 1}}), fit({{1.0, 5, 0}, {2.0, 5, 5}}), fit({{0.0, 40, 40}, {1.0, 40, 40}}),
          fit({{-1e9, 3, 0}, {1e9, 3, 3}}), fit({{1.0, 1, 1}}, true),
          fit({{1.0, 5, 0}, {2.0, 5, 5}}, true), fit({{0.0, 40, 40}, {1.0, 40, 40}}, true),
          fit({{-1e9, 3, 0}, {1e9, 3, 3}}, true)}) {
        EXPECT_TRUE(std::isfinite(found.x));
        EXPECT_TRUE(std::isfinite(found.low));
        EXPECT_LE(found.low, found.x);
        EXPECT_GE(found.high, found.x);
        EXPECT_GT(found.people.function.spread, 0.0);
    }
    EXPECT_TRUE(fit({{0.0, 40, 40}, {1.0, 40, 40}}).outside);  // always yes: it lies below
    // A step is found where it is.
    EXPECT_NEAR(fit({{1.0, 50, 0}, {1.5, 50, 0}, {2.0, 50, 50}}).x, 1.75, 0.2);
}

TEST(PsychometricFit, TellsThePeoplesSpreadFromTheirNoise) {
    std::mt19937_64 random(5);
    std::normal_distribution<double> normal;
    std::vector<std::vector<LevelCount>> people;
    for (int person = 0; person < 60; ++person) {
        const double threshold = 0.1 + 0.3 * normal(random);
        std::vector<LevelCount>& counts = people.emplace_back();
        for (double x = -1.0; x <= 1.0; x += 0.25) {
            LevelCount count{x, 20, 0};
            for (int trial = 0; trial < 20; ++trial) {
                count.yes += x + 0.15 * normal(random) > threshold ? 1 : 0;
            }
            counts.push_back(count);
        }
    }
    const FittedPeople found = fit_people(people, {.adaptive = true});
    EXPECT_NEAR(found.people, 0.3, 0.06);
    EXPECT_NEAR(found.function.spread, 0.15, 0.03);
    EXPECT_NEAR(found.function.threshold, 0.1, 0.1);
    // Together they are as broad as both.
    EXPECT_NEAR(fit_people(people, {}).function.spread, std::hypot(0.3, 0.15), 0.05);
}

TEST(PsychometricFit, PosteriorOfManyAnswersIsAsWideAsTheInformation) {
    const PsychometricFunction truth{.threshold = 0.2, .spread = 0.3};
    constexpr std::uint32_t kTrials = 4000;
    const std::vector<std::vector<LevelCount>> one{exact_counts(truth, kTrials)};
    const FittedThreshold found =
        fit_threshold(one, {.adaptive = true, .resamples = 1000, .level = 0.9});
    // As a bootstrap of the same counts.
    const FittedThreshold drawn = fit_threshold(one, {.resamples = 1000, .level = 0.9});
    EXPECT_NEAR(found.x, truth.threshold, 3.0 * drawn.deviation);
    EXPECT_NEAR(found.deviation, drawn.deviation, 0.1 * drawn.deviation);
    EXPECT_NEAR(found.high - found.low, drawn.high - drawn.low, 0.1 * (drawn.high - drawn.low));
    // The same again by the same seed.
    EXPECT_EQ(found.low,
              fit_threshold(one, {.adaptive = true, .resamples = 1000, .level = 0.9}).low);
}

TEST(PsychometricFit, PosteriorReachesFartherWhereNobodyWasAsked) {
    // Each person stops at the first yes from below, and so tells little of what lies above.
    std::vector<std::vector<LevelCount>> people;
    for (std::uint32_t person = 0; person < 8; ++person) {
        people.push_back(
            {{0.0, 6, 0}, {0.2, 6, 1}, {0.4, 5, 1 + person % 2}, {0.6, 4 - person % 2, 2}});
    }
    const FittedThreshold found = fit_threshold(people, {.adaptive = true});
    EXPECT_GT(found.high - found.x, 1.2 * (found.x - found.low));
    EXPECT_GT(found.x, found.people.together().x_where(0.5));
}

}  // namespace
}  // namespace gazeloop::statistics
