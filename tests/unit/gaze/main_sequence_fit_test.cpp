#include "runtime/gaze/main_sequence_fit.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>
#include <vector>

#include "runtime/gaze/main_sequence.h"

namespace gazeloop::gaze {
namespace {

std::vector<SaccadePoint> made(double saturation, double bend, double noise, int count) {
    std::mt19937_64 random(7);
    std::normal_distribution<double> scatter(0.0, 1.0);
    std::vector<SaccadePoint> points;
    for (int i = 0; i < count; ++i) {
        const double a = 2.0 + 20.0 * i / count;
        points.push_back({a, -saturation * std::expm1(-a / bend) + noise * scatter(random),
                          2.2 * a + 21.0 + 0.05 * noise * scatter(random)});
    }
    return points;
}

TEST(MainSequenceFit, FindsTheCurveThatPointsLieOn) {
    for (const auto& [saturation, bend] : {std::pair{596.0, 6.47}, {450.0, 12.0}, {700.0, 3.0}}) {
        const auto fit = fit_main_sequence(made(saturation, bend, 0.0, 40));
        ASSERT_TRUE(fit);
        EXPECT_NEAR(fit->saturation_deg_per_s, saturation, 1e-3 * saturation);
        EXPECT_NEAR(fit->bend_deg, bend, 2e-3 * bend);
        EXPECT_LT(fit->peak_rmse_deg_per_s, 0.1);
        EXPECT_NEAR(fit->ms_per_deg, 2.2, 1e-9);
        EXPECT_NEAR(fit->intercept_ms, 21.0, 1e-8);
        EXPECT_TRUE(fit->saturates);
    }
}

TEST(MainSequenceFit, FindsItThroughNoise) {
    const auto fit = fit_main_sequence(made(596.0, 6.47, 60.0, 500));
    ASSERT_TRUE(fit);
    EXPECT_NEAR(fit->saturation_deg_per_s, 596.0, 20.0);
    EXPECT_NEAR(fit->bend_deg, 6.47, 0.7);
    EXPECT_NEAR(fit->peak_rmse_deg_per_s, 60.0, 5.0);
    EXPECT_NEAR(fit->peak_over_published, 1.0, 0.02);
    EXPECT_EQ(fit->saccades, 500U);
}

TEST(MainSequenceFit, SaysWhereNothingSaturates) {
    std::vector<SaccadePoint> straight;
    for (int i = 1; i <= 30; ++i) {
        straight.push_back({0.5 * i, 30.0 * 0.5 * i, 20.0});
    }
    const auto fit = fit_main_sequence(straight);
    ASSERT_TRUE(fit);
    EXPECT_FALSE(fit->saturates);
    EXPECT_NEAR(fit->saturation_deg_per_s / fit->bend_deg, 30.0, 3.0);
}

TEST(MainSequenceFit, DoesWithoutPointsThatAreNone) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    constexpr double kInfinity = std::numeric_limits<double>::infinity();
    std::vector<SaccadePoint> points = made(596.0, 6.47, 0.0, 40);
    const auto whole = fit_main_sequence(points);
    for (const SaccadePoint& bad : {SaccadePoint{kNan, 1.0, 1.0}, SaccadePoint{1.0, kInfinity, 1.0},
                                    SaccadePoint{0.0, 1.0, 1.0}, SaccadePoint{5.0, -1.0, 1.0},
                                    SaccadePoint{5.0, 100.0, 0.0}}) {
        points.push_back(bad);
    }
    EXPECT_EQ(fit_main_sequence(points)->saturation_deg_per_s, whole->saturation_deg_per_s);
    EXPECT_FALSE(fit_main_sequence({}));
    EXPECT_FALSE(fit_main_sequence(made(596.0, 6.47, 0.0, 9)));
    const std::vector<SaccadePoint> alike(20, {5.0, 300.0, 28.0});
    EXPECT_FALSE(fit_main_sequence(alike)) << "one amplitude tells no slope";
}

}  // namespace
}  // namespace gazeloop::gaze
