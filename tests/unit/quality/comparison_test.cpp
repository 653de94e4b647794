#include "runtime/quality/comparison.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "runtime/quality/heat_map.h"
#include "runtime/quality/quality_totals.h"
#include "tests/unit/quality/made_pictures.h"

namespace gazeloop::quality {
namespace {

using tests::box_blurred;
using tests::flat_view;
using tests::grey_picture;
using tests::looking;
using tests::textured_picture;

TEST(Comparison, AnswersWhatIsAsked) {
    const auto a = textured_picture(60, 50);
    const auto b = box_blurred(a, 1);
    for (std::size_t metric = 0; metric < kMetrics; ++metric) {
        ComparisonQuestion question{.view = flat_view(60, 50, 30.0), .metrics = {}};
        question.metrics[metric] = true;
        const auto quality =
            Comparison::create(question).value().compare(a, b, looking(3.0)).value();
        EXPECT_EQ(quality.contrast.has_value(), metric == 0);
        EXPECT_EQ(quality.flip.has_value(), metric == 1);
        EXPECT_EQ(quality.ssim.has_value(), metric == 2);
        EXPECT_EQ(quality.psnr_db.has_value(), metric == 3);
    }
    ComparisonQuestion none{.view = flat_view(60, 50, 30.0), .metrics = {}};
    EXPECT_FALSE(Comparison::create(none));
    none.metrics = kEveryMetric;
    none.line.slope = -1.0;
    EXPECT_FALSE(Comparison::create(none));
}

TEST(Comparison, LooksWithFlipFromTheGaze) {
    const auto a = textured_picture(60, 60);
    const ComparisonQuestion question{.view = flat_view(60, 60, 45.0)};
    auto comparison = Comparison::create(question).value();
    // 30 px per unit of tangent, by pi / 180; at 45 degrees 2^(3/4) as many, also from beyond.
    const double middle = 30.0 * std::numbers::pi / 180.0;
    EXPECT_NEAR(comparison.compare(a, a, looking(0.0))->flip_pixels_per_degree, middle, 1e-9);
    EXPECT_NEAR(comparison.compare(a, a, looking(45.0))->flip_pixels_per_degree,
                middle * std::pow(2.0, 0.75), 1e-6);
    EXPECT_NEAR(comparison.compare(a, a, looking(80.0))->flip_pixels_per_degree,
                middle * std::pow(2.0, 0.75), 1e-6);
}

TEST(QualityTotals, AverageErrorsAndKnowTheWorst) {
    QualityTotals totals;
    const auto frame = [](double contrast, double psnr) {
        FrameQuality quality;
        quality.contrast.emplace().value = contrast;
        quality.psnr_db = {psnr, 2.0 * psnr};
        return quality;
    };
    totals.add(frame(1.0, 20.0));
    totals.add(frame(4.0, std::numeric_limits<double>::infinity()));
    totals.add(frame(1.0, 40.0));
    const auto figures = totals.figures();
    ASSERT_EQ(figures.size(), 1 + kMechanisms + 2);
    EXPECT_EQ(figures[0].key, "contrast");
    EXPECT_EQ(figures[0].mean, 2.0);
    EXPECT_EQ(figures[0].worst, 4.0);
    EXPECT_EQ(figures[0].worst_frame, 1U);
    const QualityFigure& psnr = figures[1 + kMechanisms];
    EXPECT_EQ(psnr.key, "psnr_db");
    EXPECT_NEAR(psnr.mean, -10.0 * std::log10((1e-2 + 0.0 + 1e-4) / 3.0), 1e-9);
    EXPECT_EQ(psnr.worst, 20.0);
    EXPECT_EQ(psnr.worst_frame, 0U);
    EXPECT_FALSE(psnr.lower_is_better);
}

TEST(HeatMap, GrowsBrighterWithTheValue) {
    Plane map(7, 1);
    map.values = {0.0F, 0.1F, 0.5F, 2.0F, 7.0F, 15.0F, 1e9F};
    const render::Picture picture = heat_map(map, 15.0);
    EXPECT_EQ(picture.pixels.front(), (std::array<std::uint8_t, 3>{0, 0, 0}));
    EXPECT_EQ(picture.pixels[5], (std::array<std::uint8_t, 3>{255, 255, 255}));
    EXPECT_EQ(picture.pixels[6], picture.pixels[5]);
    const auto luminance = [&](std::size_t at) {
        const glm::vec3 linear = render::linear_of(picture.pixels[at]);
        return 0.2126F * linear.x + 0.7152F * linear.y + 0.0722F * linear.z;
    };
    for (std::size_t at = 1; at < 6; ++at) {
        EXPECT_GT(luminance(at), luminance(at - 1)) << at;
    }
}

}  // namespace
}  // namespace gazeloop::quality
