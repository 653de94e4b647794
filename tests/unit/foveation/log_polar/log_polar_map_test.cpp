#include "runtime/foveation/log_polar/log_polar_map.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

namespace gazeloop::foveation {
namespace {

constexpr ImageSize kFullHd{1920, 1080};
constexpr gaze::PixelPosition kCentre{960.0, 540.0};
constexpr std::uint32_t kColumns = 1067;  // sigma 1.8

struct AlphaFigures {
    double alpha;
    double outer_share;      ///< of columns with r > rmax / 2
    double first_column_px;  ///< r of the first column's centre
};

void PrintTo(const AlphaFigures& at, std::ostream* out) { *out << at.alpha; }

class PublishedForm : public testing::TestWithParam<AlphaFigures> {};

// Variant B at 1920x1080, centred fovea: larger alpha gives the periphery the larger share. The
// exchanged variant (the paper's Eq. 10 as printed) gives .025 instead of .341 at alpha 4.
TEST_P(PublishedForm, HasTheReferenceColumns) {
    const LogPolarMap map({GetParam().alpha}, kFullHd, kCentre);
    int outer = 0;
    for (std::uint32_t i = 0; i < kColumns; ++i) {
        outer += map.radius_px((i + 0.5) / kColumns) > map.max_radius_px() / 2 ? 1 : 0;
    }
    EXPECT_NEAR(static_cast<double>(outer) / kColumns, GetParam().outer_share, 6e-4);
    EXPECT_NEAR(map.radius_px(0.5 / kColumns), GetParam().first_column_px, 0.051);
}

INSTANTIATE_TEST_SUITE_P(Alphas, PublishedForm,
                         testing::Values(AlphaFigures{1, .099, 1.0}, AlphaFigures{2, .188, 1.2},
                                         AlphaFigures{3, .268, 1.7}, AlphaFigures{4, .341, 2.8},
                                         AlphaFigures{5, .406, 4.5}, AlphaFigures{6, .465, 7.0},
                                         AlphaFigures{8, .565, 14.7}),
                         [](const auto& instance) {
                             return "alpha" +
                                    std::to_string(static_cast<int>(instance.param.alpha));
                         });

TEST(LogPolarMap, InvertsWithinDoubleRounding) {
    for (const double alpha : {0.25, 0.5, 1.0, 4.0, 8.0, 16.0}) {
        for (const ImageSize image :
             {ImageSize{2, 2}, ImageSize{64, 48}, ImageSize{16384, 16384}}) {
            for (const gaze::PixelPosition fovea :
                 {gaze::PixelPosition{image.width_px / 2.0, image.height_px / 2.0},
                  gaze::PixelPosition{0, 0}, gaze::PixelPosition{-2.0 * image.width_px, 3.0}}) {
                const LogPolarMap map({alpha}, image, fovea);
                for (double share = 0.0; share <= 1.0; share += 0.05) {
                    const double r = std::pow(map.max_radius_px(), share);
                    // r = 1 px is u = 0, where alpha > 1 flattens the map; elsewhere it inverts.
                    const double back = map.radius_px(map.u(r));
                    EXPECT_NEAR(back / r, 1.0, 1e-9) << alpha << ' ' << r;
                }
            }
        }
    }
}

TEST(LogPolarMap, IsFiniteWhereTheLogarithmIsNot) {
    const LogPolarMap map({0.25}, kFullHd, kCentre);
    EXPECT_EQ(map.u(0.0), 0.0);
    EXPECT_EQ(map.u(0.5), 0.0);
    EXPECT_EQ(map.u(1.0), 0.0);
    EXPECT_EQ(map.radius_px(0.0), 1.0);
    EXPECT_EQ(map.radius_px(-1.0), 1.0);
    EXPECT_DOUBLE_EQ(map.u(map.max_radius_px()), 1.0);
    EXPECT_EQ(map.texels_per_pixel(0.0, {100, 100}), 0.0);
}

TEST(LogPolarMap, ReachesTheFarthestCornerFromAnywhere) {
    EXPECT_DOUBLE_EQ(LogPolarMap({4}, kFullHd, {0, 0}).max_radius_px(), std::hypot(1920, 1080));
    EXPECT_DOUBLE_EQ(LogPolarMap({4}, kFullHd, {1920, 1080}).max_radius_px(),
                     std::hypot(1920, 1080));
    EXPECT_DOUBLE_EQ(LogPolarMap({4}, kFullHd, {-480, 540}).max_radius_px(), std::hypot(2400, 540));
    EXPECT_GT(LogPolarMap({4}, {2, 2}, {1, 1}).max_radius_px(), 1.0);
}

// A prototype measured 144 px at 1920x1080.
TEST(LogPolarMap, OffersATexelAPixelUpToTheDiscRadius) {
    const LpSize lp{kColumns, 600};
    const LogPolarMap map({4}, kFullHd, kCentre);
    const double radius = map.disc_radius_px(lp);
    EXPECT_NEAR(radius, 144.0, 1.0);
    EXPECT_NEAR(map.texels_per_pixel(radius, lp), 1.0, 1e-4);
    EXPECT_GT(map.texels_per_pixel(radius * 0.9, lp), 1.0);
    EXPECT_LT(map.texels_per_pixel(radius * 1.1, lp), 1.0);
}

TEST(LogPolarMap, ClosesTheHoleWhereNoTexelAPixelIsOffered) {
    const LogPolarMap map({4}, kFullHd, kCentre);
    const LpSize sparse{60, 34};
    const double radius = map.disc_radius_px(sparse);
    EXPECT_NEAR(radius, std::exp(1.5), 1e-6);  // the density's peak, (alpha - 1) / 2 in ln r
    EXPECT_LT(map.texels_per_pixel(radius, sparse), 1.0);
    EXPECT_LT(map.texels_per_pixel(radius * 0.8, sparse), map.texels_per_pixel(radius, sparse));
    EXPECT_LT(map.texels_per_pixel(radius * 1.2, sparse), map.texels_per_pixel(radius, sparse));
    EXPECT_EQ(LogPolarMap({1}, kFullHd, kCentre).disc_radius_px({8, 4}), 0.0);
    // A hole as large as the screen is not closed by rendering it all.
    const double hole = LogPolarMap({16}, kFullHd, kCentre).disc_radius_px(sparse);
    EXPECT_NEAR(std::numbers::pi * hole * hole, 0.1 * 60 * 34, 1e-6);
}

TEST(LogPolarMap, DensityIsTheMapsDerivative) {
    const LpSize lp{500, 400};
    const LogPolarMap map({3}, kFullHd, {100, 200});
    for (const double r : {2.0, 10.0, 100.0, 1000.0}) {
        const double h = r * 1e-6;
        const double radial = (map.u(r + h) - map.u(r - h)) / (2 * h) * lp.width;
        const double tangential = lp.height / (2 * std::numbers::pi * r);
        EXPECT_NEAR(map.texels_per_pixel(r, lp) / (radial * tangential), 1.0, 1e-6);
    }
}

struct Refused {
    const char* name;
    KfrParameters parameters;
    ImageSize image;
    const char* message;
};

void PrintTo(const Refused& at, std::ostream* out) { *out << at.name; }

class LpBufferRefuses : public testing::TestWithParam<Refused> {};

TEST_P(LpBufferRefuses, WithTheValueAndTheRange) {
    const auto size = lp_buffer_size(GetParam().parameters, GetParam().image);
    ASSERT_FALSE(size.has_value());
    EXPECT_EQ(size.error().kind, ErrorKind::Usage);
    EXPECT_NE(size.error().message.find(GetParam().message), std::string::npos)
        << size.error().message;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kInfinity = std::numeric_limits<double>::infinity();
INSTANTIATE_TEST_SUITE_P(
    BadInput, LpBufferRefuses,
    testing::Values(
        Refused{"sigma_nan", {.sigma = kNan, .kernel = {}}, kFullHd, "kfr.sigma = nan"},
        Refused{"sigma_zero", {.sigma = 0, .kernel = {}}, kFullHd, "[0.5, 32]"},
        Refused{"sigma_large", {.sigma = 32.1, .kernel = {}}, kFullHd, "kfr.sigma = 32.1"},
        Refused{"alpha_nan", {.kernel = {kNan}}, kFullHd, "kfr.alpha = nan"},
        Refused{"alpha_zero", {.kernel = {0}}, kFullHd, "[0.25, 16]"},
        Refused{"alpha_infinite", {.kernel = {kInfinity}}, kFullHd, "kfr.alpha = inf"},
        Refused{"border", {.kernel = {}, .border_px = -1}, kFullHd, "kfr.border_px = -1"},
        Refused{"no_pixels", {.kernel = {}}, {0, 0}, "0x0 px"},
        Refused{"one_pixel", {.kernel = {}}, {1, 1}, "1x1 px"},
        Refused{"one_column", {.kernel = {}}, {1, 4000}, "1x4000 px"},
        Refused{"too_large", {.kernel = {}}, {16385, 10}, "16385x10 px"},
        Refused{"too_few_texels", {.sigma = 32, .kernel = {}}, {64, 64}, "2x2 texels"},
        Refused{"too_many_texels", {.sigma = 0.5, .kernel = {}}, {16384, 64}, "32768x128"}),
    [](const auto& instance) { return instance.param.name; });

TEST(LpBuffer, IsThePictureOverSigma) {
    EXPECT_EQ(lp_buffer_size({.sigma = 1.8, .kernel = {}}, kFullHd), (LpSize{1067, 600}));
    EXPECT_EQ(lp_buffer_size({.sigma = 1.0, .kernel = {}}, {16384, 16384}), (LpSize{16384, 16384}));
    EXPECT_EQ(lp_buffer_size({.sigma = 0.5, .kernel = {}}, {2, 2}), (LpSize{4, 4}));
}

}  // namespace
}  // namespace gazeloop::foveation
