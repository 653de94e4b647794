#include "runtime/quality/contrast_shares.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <numbers>

#include "tests/unit/quality/made_pictures.h"

namespace gazeloop::quality {
namespace {

using tests::flat_view;
using tests::grey_picture;
using tests::looking;
using tests::made_picture;
using tests::textured_picture;

const RowWork kTwoThreads(2);

// 8 degrees wide, 50 pixels per degree.
constexpr std::uint32_t kSide_px = 400;
constexpr double kHalf_deg = 4.0;

/// A grating of so many cycles per degree and this contrast, all over the view.
render::LinearPicture grating(double cpd, double contrast = 0.2) {
    return made_picture(kSide_px, kSide_px, [=](int x, int) {
        const double phase =
            2.0 * std::numbers::pi * cpd * (x - kSide_px / 2.0) / (kSide_px / (2.0 * kHalf_deg));
        return static_cast<float>(0.4 * (1.0 + contrast * std::sin(phase)));
    });
}

ContrastShares shares(const render::LinearPicture& picture, const glm::dvec3& gaze,
                      const foveation::MarLine& line = {}) {
    return contrast_shares(picture, flat_view(picture.width, picture.height, kHalf_deg), gaze, line,
                           {.peak_cd_m2 = 100.0, .black_cd_m2 = 0.0}, kTwoThreads)
        .value();
}

// Seen 36 to 44 degrees off the gaze, the line cuts off at 1.23 to 1.01 cycles per degree, the
// limit at 14.1 to 12.2.
TEST(ContrastShares, PutAGratingWhereItsFrequencyLies) {
    const glm::dvec3 aside = looking(40.0);
    EXPECT_GT(shares(grating(0.6), aside).kept, 0.85);
    EXPECT_GT(shares(grating(4.0), aside).between, 0.97);
    // The finest band, from 10 to 21, takes all that is above it, and reaches below the limit.
    EXPECT_GT(shares(grating(22.0), aside).beyond, 0.65);
    EXPECT_LT(shares(grating(22.0), aside).kept, 0.01);
    // In the middle the eye resolves what the display shows.
    EXPECT_GT(shares(grating(4.0), looking(0.0)).kept, 0.97);
    EXPECT_GT(
        shares(grating(22.0), looking(0.0)).between + shares(grating(22.0), looking(0.0)).kept,
        0.97);
}

TEST(ContrastShares, AddUpToOneAndToTheContrastThere) {
    const auto of = shares(grating(4.0, 0.3), looking(40.0));
    EXPECT_NEAR(of.kept + of.between + of.beyond, 1.0, 1e-12);
    // A grating of amplitude c has a root mean square of c / sqrt 2. Bands overlap: from one that
    // lies on a band (50 pixels per degree, .2115 cycles per pixel, halved) to one in between.
    for (const double cpd : {5.3, 4.0, 2.65}) {
        const double seen = shares(grating(cpd, 0.3), looking(40.0)).contrast;
        EXPECT_GT(seen, 0.95 * 0.3 / std::numbers::sqrt2) << cpd;
        EXPECT_LT(seen, 1.3 * 0.3 / std::numbers::sqrt2) << cpd;
    }
    // Twice as much at twice the contrast, but for what the bands rest on.
    const auto half = shares(grating(4.0, 0.15), looking(40.0));
    EXPECT_NEAR(half.contrast, 0.5 * of.contrast, 0.01 * of.contrast);
    EXPECT_NEAR(half.between, of.between, 0.01);
}

TEST(ContrastShares, AreNothingWhereThereIsNoContrast) {
    const auto of = shares(grey_picture(kSide_px, kSide_px, 0.3F), looking(10.0));
    EXPECT_LT(of.contrast, 1e-5);
    const auto black = shares(grey_picture(kSide_px, kSide_px, 0.0F), looking(10.0));
    EXPECT_EQ(black.kept + black.between + black.beyond, 0.0);
    EXPECT_EQ(black.contrast, 0.0);
}

TEST(ContrastShares, MoveWithTheLineAndFallWithEccentricity) {
    const auto picture = textured_picture(kSide_px, kSide_px);
    double before = 1.1;
    for (const double off_deg : {0.0, 5.0, 10.0, 20.0, 40.0, 80.0}) {
        const auto of = shares(picture, looking(off_deg));
        EXPECT_LT(of.kept, before) << off_deg;
        before = of.kept;
    }
    EXPECT_GT(shares(picture, looking(20.0), {.slope = 0.011}).kept,
              shares(picture, looking(20.0), {.slope = 0.034}).kept);
}

TEST(ContrastShares, AreTheSameBitsWithAnyNumberOfThreads) {
    const auto picture = textured_picture(131, 77);
    const auto view = flat_view(131, 77, 40.0);
    const auto one = contrast_shares(picture, view, looking(7.0), {}, {}, RowWork(1)).value();
    const auto many = contrast_shares(picture, view, looking(7.0), {}, {}, RowWork(5)).value();
    EXPECT_EQ(one.kept, many.kept);
    EXPECT_EQ(one.between, many.between);
    EXPECT_EQ(one.contrast, many.contrast);
}

TEST(ContrastShares, RefuseWhatTheyCannotTell) {
    const auto view = flat_view(8, 8, 10.0);
    auto picture = grey_picture(8, 8, 0.5F);
    EXPECT_TRUE(contrast_shares(picture, view, looking(0.0), {}, {}, kTwoThreads));
    EXPECT_FALSE(contrast_shares(picture, view, glm::dvec3(0.0), {}, {}, kTwoThreads));
    EXPECT_FALSE(contrast_shares(picture, view, looking(0.0), {.slope = 0.0}, {}, kTwoThreads));
    EXPECT_FALSE(
        contrast_shares(grey_picture(7, 8, 0.5F), view, looking(0.0), {}, {}, kTwoThreads));
    picture.pixels[9].x = std::numeric_limits<float>::quiet_NaN();
    EXPECT_FALSE(contrast_shares(picture, view, looking(0.0), {}, {}, kTwoThreads));
    // As small as can be: no band, no contrast.
    EXPECT_EQ(contrast_shares(grey_picture(1, 1, 0.5F), flat_view(1, 1, 10.0), looking(0.0), {}, {},
                              kTwoThreads)
                  .value()
                  .contrast,
              0.0);
}

}  // namespace
}  // namespace gazeloop::quality
