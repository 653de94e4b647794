#include "runtime/foveation/plans/eccentricity_layers.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>
#include <limits>

#include "runtime/foveation/plans/layer_plan.h"
#include "runtime/foveation/plans/layer_prediction.h"
#include "tests/unit/foveation/picture/example_views.h"

namespace gazeloop::foveation {
namespace {

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The paper's: 59 cm away, 51 cm wide, 1920x1080.
constexpr LayerDisplay kPaper{51.0 / (2 * 59.0), 1920.0, 9.0 / 16.0};
constexpr MarLine kA{.slope = 0.0275};
constexpr MarLine kB{.slope = 0.0220};

EccentricityLayers solve(const LayerDisplay& display, const MarLine& line,
                         const LayerOptions& options) {
    return optimise_layers(display, line, options).value();
}

TEST(LayerDisplay, OfThePaperHasItsAngles) {
    EXPECT_NEAR(kPaper.radius_deg(), 23.37, 0.01);
    EXPECT_NEAR(kPaper.sharpness_deg(), 0.0516, 0.0001);
    EXPECT_NEAR(1.0 / 48.0 / kPaper.sharpness_deg(), 0.404, 0.0005);
}

struct Published {
    const char* name;
    MarLine line;
    double e1, e2, s2, s3;
    double ratio;
    double half_rate_ratio;
};

void PrintTo(const Published& at, std::ostream* out) { *out << at.name; }

class PublishedLayers : public testing::TestWithParam<Published> {};

TEST_P(PublishedLayers, AreReproduced) {
    const Published& at = GetParam();
    const EccentricityLayers layers = solve(kPaper, at.line, {.layers = 3, .weights = {}});
    ASSERT_EQ(layers.layers.size(), 3U);
    // The minimum is flat: the published radii are a grid's, a few hundredths of a degree off.
    EXPECT_NEAR(layers.layers[0].radius_deg, at.e1, 0.025);
    EXPECT_NEAR(layers.layers[1].radius_deg, at.e2, 0.025);
    EXPECT_NEAR(layers.layers[2].radius_deg, kPaper.radius_deg(), 1e-9);
    EXPECT_EQ(layers.layers[0].factor, 1.0);
    EXPECT_NEAR(layers.layers[1].factor, at.s2, 0.01);
    EXPECT_NEAR(layers.layers[2].factor, at.s3, 0.01);
    EXPECT_NEAR(layers.pixel_ratio(), at.ratio, 0.01);
    const auto pixels = [](double factor, double radius_deg) {
        return std::pow(kPaper.width_px / factor * std::tan(glm::radians(radius_deg)) /
                            kPaper.half_width_tangent,
                        2);
    };
    const auto factor = [&](double radius_deg) {
        return at.line.omega_deg(radius_deg) / kPaper.sharpness_deg();
    };
    EXPECT_LE(layers.work, pixels(1.0, at.e1) + pixels(factor(at.e1), at.e2) +
                               kPaper.aspect * std::pow(kPaper.width_px / factor(at.e2), 2));
    // The same layers with the outer two rendered at half rate, as the studied system does.
    const double half_rate =
        layers.layers[0].pixels + 0.5 * (layers.layers[1].pixels + layers.layers[2].pixels);
    EXPECT_NEAR(layers.display_pixels / half_rate, at.half_rate_ratio, 0.01);
}

INSTANTIATE_TEST_SUITE_P(Qualities, PublishedLayers,
                         testing::Values(Published{"A", kA, 3.36, 8.11, 2.19, 4.73, 8.50, 13.29},
                                         Published{"B", kB, 3.83, 8.66, 2.04, 4.09, 6.43, 10.10}),
                         [](const auto& instance) { return instance.param.name; });

// Optimised for the half rate, the inner layer shrinks, and a little more is saved.
TEST(EccentricityLayers, WeightsMoveTheBoundaries) {
    const LayerOptions half{.layers = 3, .weights = {1.0, 0.5, 0.5}};
    for (const MarLine& line : {kA, kB}) {
        const EccentricityLayers even = solve(kPaper, line, {.layers = 3, .weights = {}});
        const EccentricityLayers weighted = solve(kPaper, line, half);
        EXPECT_LT(weighted.layers[0].radius_deg, even.layers[0].radius_deg);
        const double even_at_half =
            even.layers[0].pixels + 0.5 * (even.layers[1].pixels + even.layers[2].pixels);
        EXPECT_LT(weighted.work, even_at_half);
        EXPECT_GT(weighted.work, 0.9 * even_at_half);
        EXPECT_EQ(weighted.layers[1].weight, 0.5);
    }
}

struct Hmd {
    const char* name;
    gaze::EyeView view;
    double ratio;
};

void PrintTo(const Hmd& at, std::ostream* out) { *out << at.name; }

class HeadMounted : public testing::TestWithParam<Hmd> {};

TEST_P(HeadMounted, SavesTheReferenceRatio) {
    const EccentricityLayers layers =
        solve(layer_display(GetParam().view), kB, {.layers = 3, .weights = {}});
    EXPECT_NEAR(layers.pixel_ratio() / GetParam().ratio, 1.0, 0.02) << layers.pixel_ratio();
}

INSTANTIATE_TEST_SUITE_P(Displays, HeadMounted,
                         testing::Values(Hmd{"fove", fove_view(), 4.6},
                                         Hmd{"vive_pro_eye", vive_pro_eye_view(), 5.6},
                                         Hmd{"square_2160", square_2160_view(), 9.1},
                                         Hmd{"xr4", xr4_view(), 18.8}),
                         [](const auto& instance) { return instance.param.name; });

/// The paper's own method: every pair on a fine grid.
double brute_force(const LayerDisplay& display, const MarLine& line, double weight2,
                   double weight3) {
    constexpr int kSteps = 2000;
    const double radius = display.radius_deg();
    const auto square = [](double x) { return x * x; };
    double best = display.aspect * square(display.width_px);
    std::vector<double> area(kSteps);
    std::vector<double> factor2(kSteps);
    for (int i = 0; i < kSteps; ++i) {
        const double e = radius * i / kSteps;
        area[i] = square(display.width_px * std::tan(glm::radians(e)) / display.half_width_tangent);
        factor2[i] = square(std::max(1.0, line.omega_deg(e) / display.sharpness_deg()));
    }
    for (int i = 0; i < kSteps; ++i) {
        for (int j = i; j < kSteps; ++j) {
            best = std::min(best,
                            area[i] + weight2 * area[j] / factor2[i] +
                                weight3 * display.aspect * square(display.width_px) / factor2[j]);
        }
    }
    return best;
}

TEST(EccentricityLayers, AreNoWorseThanBruteForce) {
    for (const double half_width : {1e-3, 0.1, 0.43, 1.2, 3.0, 11.0, 114.0}) {
        for (const double per_radian : {20.0, 500.0, 3000.0, 40000.0}) {
            for (const double slope : {1e-6, 0.005, 0.022, 0.034, 0.3}) {
                for (const double weight : {1.0, 0.5}) {
                    const LayerDisplay display{half_width,
                                               std::max(2.0, 2 * half_width * per_radian), 0.8};
                    const MarLine line{.slope = slope};
                    const EccentricityLayers layers =
                        solve(display, line, {.layers = 3, .weights = {1.0, weight, weight}});
                    const double brute = brute_force(display, line, weight, weight);
                    EXPECT_LE(layers.work, brute * (1 + 1e-9))
                        << half_width << ' ' << per_radian << ' ' << slope << ' ' << weight;
                    // The grid's own error.
                    EXPECT_GE(layers.work, brute * 0.98);
                }
            }
        }
    }
}

// Layers overlap, so that a sixth one costs what it saves on the paper's display.
TEST(EccentricityLayers, MoreLayersNeverCostMore) {
    for (const MarLine& line : {kA, kB}) {
        double before = kInfinity;
        for (int n = 1; n <= LayerOptions::kMaxLayers; ++n) {
            const EccentricityLayers layers = solve(kPaper, line, {.layers = n, .weights = {}});
            EXPECT_LE(layers.work, before) << n;
            EXPECT_EQ(layers.layers.size(), static_cast<std::size_t>(std::min(n, 5)));
            before = layers.work;
        }
    }
}

TEST(EccentricityLayers, SecondFactorIsFixedOnRequest) {
    for (const MarLine& line : {kA, kB}) {
        const EccentricityLayers free = solve(kPaper, line, {.layers = 3, .weights = {}});
        const EccentricityLayers fixed =
            solve(kPaper, line, {.layers = 3, .weights = {}, .second_factor = 2.0});
        ASSERT_EQ(fixed.layers.size(), 3U);
        EXPECT_EQ(fixed.layers[1].factor, 2.0);
        // Not a sample earlier than the line allows it.
        EXPECT_NEAR(line.omega_deg(fixed.layers[0].radius_deg), 2.0 * kPaper.sharpness_deg(),
                    1e-12);
        EXPECT_GE(fixed.work, free.work);
        EXPECT_LT(fixed.work, 1.02 * free.work);  // s2 is close to 2 here anyway
    }
    // No room for it: the line reaches twice the display's angle only beyond its edge.
    const LayerDisplay coarse{0.4, 200.0, 1.0};
    EXPECT_EQ(solve(coarse, kB, {.layers = 3, .weights = {}, .second_factor = 2.0}).layers.size(),
              1U);
}

TEST(EccentricityLayers, AreFewerWhereMoreSaveNothing) {
    // Coarser than the eye everywhere.
    for (const LayerDisplay& display : {LayerDisplay{0.4, 20.0, 1.0}, LayerDisplay{1.19, 2.0, 1.0},
                                        LayerDisplay{2e-3, 2.0, 1.0}}) {
        const EccentricityLayers layers = solve(display, kB, {.layers = 4, .weights = {}});
        ASSERT_EQ(layers.layers.size(), 1U);
        EXPECT_EQ(layers.layers[0].factor, 1.0);
        EXPECT_DOUBLE_EQ(layers.pixel_ratio(), 1.0);
    }
    // A flat line: one layer, at the display's pixels or at the eye's limit, whichever is coarser.
    const MarLine flat{.slope = 1e-6};
    EXPECT_EQ(solve(kPaper, flat, {.layers = 4, .weights = {}}).layers.size(), 1U);
    const LayerDisplay fine{0.4, 40000.0, 1.0};
    const EccentricityLayers limited = solve(fine, flat, {.layers = 4, .weights = {}});
    EXPECT_NEAR(limited.layers.back().factor, 1.0 / 48.0 / fine.sharpness_deg(), 1e-3);
    EXPECT_NEAR(limited.pixel_ratio(), std::pow(1.0 / 48.0 / fine.sharpness_deg(), 2), 0.01);
}

TEST(EccentricityLayers, ExtremeFieldsOfView) {
    for (const double half_width : {1e-4, 1e-2, 57.0, 1145.0, 1200.0}) {
        for (const double width_px : {2.0, 16384.0, 1e7}) {
            const EccentricityLayers layers =
                solve({half_width, width_px, 1.0}, kB, {.layers = 4, .weights = {}});
            EXPECT_TRUE(std::isfinite(layers.work));
            EXPECT_GT(layers.work, 0.0);
            EXPECT_GE(layers.pixel_ratio(), 1.0);
            for (std::size_t i = 1; i < layers.layers.size(); ++i) {
                EXPECT_GT(layers.layers[i].radius_deg, layers.layers[i - 1].radius_deg);
                EXPECT_GE(layers.layers[i].factor, layers.layers[i - 1].factor);
            }
        }
    }
}

TEST(EccentricityLayers, RefuseWithTheValueAndTheRange) {
    const auto message = [](const LayerDisplay& display, const MarLine& line,
                            const LayerOptions& options) {
        const auto layers = optimise_layers(display, line, options);
        EXPECT_FALSE(layers.has_value());
        return layers ? std::string() : layers.error().message;
    };
    using testing::HasSubstr;
    const LayerOptions three{.layers = 3, .weights = {}};
    for (const double bad : {kNan, kInfinity, 0.0, -1.0}) {
        EXPECT_THAT(message({bad, 100, 1}, kB, three), HasSubstr("half_width_tangent"));
        EXPECT_THAT(message({1, bad, 1}, kB, three), HasSubstr("width_px"));
        EXPECT_THAT(message({1, 100, bad}, kB, three), HasSubstr("aspect"));
        EXPECT_THAT(message(kPaper, {.slope = bad}, three), HasSubstr("m = "));
        EXPECT_THAT(message(kPaper, kB, {.layers = 3, .weights = {1, bad, 1}}),
                    HasSubstr("weight"));
    }
    EXPECT_THAT(message(kPaper, kB, {.layers = 0, .weights = {}}),
                HasSubstr("number of layers = 0: must lie in [1, 8]"));
    EXPECT_THAT(message(kPaper, kB, {.layers = 9, .weights = {}}), HasSubstr("[1, 8]"));
    EXPECT_THAT(message(kPaper, kB, {.layers = 2, .weights = {}, .second_factor = 2.0}),
                HasSubstr("[3, 8]"));
    EXPECT_THAT(message(kPaper, kB, {.layers = 3, .weights = {}, .second_factor = 0.5}),
                HasSubstr("second_factor = 0.5"));
    EXPECT_THAT(message(kPaper, kB, {.layers = 3, .weights = {1.0, 0.5}}),
                HasSubstr("2 weights for 3 layers"));
}

// Figures 12 and 13 of the paper, and its two claims about them.
TEST(LayerPrediction, AHundredTimesAtSeventyDegrees) {
    const LayerOptions four{.layers = 4, .weights = {}};
    EXPECT_NEAR(predict_layers(70.0, kA, four)->speedup(), 103.0, 0.5);
    EXPECT_NEAR(predict_layers(70.0, kB, four)->speedup(), 75.6, 0.5);
    EXPECT_NEAR(predict_layers(70.0, kA, {.layers = 3, .weights = {}})->speedup(), 69.2, 0.4);
    EXPECT_NEAR(predict_layers(70.0, kA, {.layers = 2, .weights = {}})->speedup(), 26.6, 0.2);
    EXPECT_LT(
        predict_layers(70.0, kA, {.layers = 3, .weights = {}, .second_factor = 2.0})->speedup(),
        69.0);
    EXPECT_NEAR(predict_layers(70.0, kA, four)->display_pixels, 44.5e6, 0.1e6);
}

TEST(LayerPrediction, CostIsAboutLinearToNinetyDegrees) {
    const LayerOptions four{.layers = 4, .weights = {}};
    for (const MarLine& line : {kA, kB}) {
        const auto growth = layer_cost_growth(20.0, 90.0, line, four);
        ASSERT_TRUE(growth.has_value());
        EXPECT_LT(growth->worst_deviation, 0.02);
        EXPECT_LT(growth->end_exponent, 1.1);
        // Without layers the cost grows with the tangent's square: at 90 degrees, with
        // exponent d ln tan^2(x / 2) / d ln x = 2 x / sin x = pi.
        const double full = std::log(predict_layers(90.0, line, four)->display_pixels /
                                     predict_layers(89.0, line, four)->display_pixels) /
                            std::log(90.0 / 89.0);
        EXPECT_NEAR(full, 3.1, 0.05);
    }
}

TEST(LayerPrediction, RefusesFieldsOfViewThatAreNone) {
    for (const double fov : {0.0, -70.0, 180.0, kNan, kInfinity}) {
        EXPECT_FALSE(predict_layers(fov, kA, {.layers = 4, .weights = {}}).has_value()) << fov;
    }
}

}  // namespace
}  // namespace gazeloop::foveation
