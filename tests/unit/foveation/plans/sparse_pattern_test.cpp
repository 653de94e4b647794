#include "runtime/foveation/plans/sparse_pattern.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace gazeloop::foveation {
namespace {

constexpr ImageSize kArticle{420, 236};

SparsePattern make(const SparseParameters& parameters, ImageSize image = kArticle) {
    return make_sparse_pattern(parameters, image).value();
}

class Placements : public testing::TestWithParam<SparsePlacement> {};
INSTANTIATE_TEST_SUITE_P(Both, Placements,
                         testing::Values(SparsePlacement::Gaussian, SparsePlacement::BlueNoise),
                         [](const auto& instance) {
                             return instance.param == SparsePlacement::Gaussian ? "gaussian"
                                                                                : "blue_noise";
                         });

TEST_P(Placements, HaveExactlyTheShareAtTheCentre) {
    for (const double share : {0.01, 0.1, 0.2, 0.5}) {
        const SparsePattern pattern = make({.share = share, .placement = GetParam()});
        EXPECT_EQ(pattern.samples_in({210.0, 118.0}),
                  static_cast<std::uint64_t>(std::llround(share * 420 * 236)));
    }
}

TEST_P(Placements, AreSortedAndDistinctAndInTheField) {
    const SparsePattern pattern = make({.placement = GetParam()});
    for (std::size_t i = 0; i < pattern.samples.size(); ++i) {
        EXPECT_LT(pattern.samples[i].x, 840);
        EXPECT_LT(pattern.samples[i].y, 472);
        if (i > 0) {
            const FieldPixel a = pattern.samples[i - 1];
            const FieldPixel b = pattern.samples[i];
            EXPECT_TRUE(a.y < b.y || (a.y == b.y && a.x < b.x));
        }
    }
}

TEST_P(Placements, AreTheSameForTheSameSeedOnly) {
    const SparseParameters parameters{.placement = GetParam()};
    SparseParameters other = parameters;
    other.seed = 2;
    EXPECT_EQ(make(parameters).samples, make(parameters).samples);
    EXPECT_NE(make(parameters).samples, make(other).samples);
}

TEST_P(Placements, TakeEveryPixelOfTheDisc) {
    const SparsePattern pattern = make({.placement = GetParam()});
    const double radius = pattern.profile.disc_radius_px;
    EXPECT_NEAR(std::numbers::pi * radius * radius, 0.25 * 0.1 * 420 * 236, 1.0);
    std::size_t inside = 0;
    std::size_t taken = 0;
    for (std::uint16_t y = 0; y < 472; ++y) {
        for (std::uint16_t x = 0; x < 840; ++x) {
            if (std::hypot(x + 0.5 - 420, y + 0.5 - 236) <= radius) {
                ++inside;
                taken += std::ranges::count(pattern.samples, FieldPixel{x, y});
            }
        }
    }
    EXPECT_EQ(taken, inside);
}

// Ring by ring, as many samples as the profile says: within 4 standard deviations of a count (blue
// noise deviates less, but its rim along the disc and the field's edge are a little off).
TEST_P(Placements, FollowTheProfile) {
    const SparsePattern pattern = make({.share = 0.15, .placement = GetParam()}, {640, 640});
    std::vector<double> expected(40);
    std::vector<double> counted(40);
    for (std::uint16_t y = 0; y < 1280; ++y) {
        for (std::uint16_t x = 0; x < 1280; ++x) {
            const double radius = std::hypot(x + 0.5 - 640, y + 0.5 - 640);
            if (radius < 640) {
                expected[static_cast<std::size_t>(radius / 16)] += pattern.profile.share(radius);
            }
        }
    }
    for (const FieldPixel& pixel : pattern.samples) {
        const double radius = std::hypot(pixel.x + 0.5 - 640, pixel.y + 0.5 - 640);
        if (radius < 640) {
            ++counted[static_cast<std::size_t>(radius / 16)];
        }
    }
    for (std::size_t ring = 0; ring < expected.size(); ++ring) {
        EXPECT_NEAR(counted[ring], expected[ring],
                    4.0 * std::sqrt(expected[ring]) + 0.06 * expected[ring])
            << ring;
    }
}

/// Mean distance to the nearest other sample over what the density makes of it: .5 for independent
/// draws, up to 1.07 for a hexagonal grid.
double relative_spacing(const SparsePattern& pattern) {
    double sum = 0.0;
    int count = 0;
    for (const FieldPixel& a : pattern.samples) {
        const double radius = std::hypot(a.x + 0.5 - 210, a.y + 0.5 - 118);
        const double share = pattern.profile.share(
            std::hypot(a.x + 0.5 - pattern.image.width_px, a.y + 0.5 - pattern.image.height_px));
        if (share > 0.1 || radius < 1.0) {
            continue;  // where pixels are coarse against the spacing
        }
        double nearest = 1e9;
        for (const FieldPixel& b : pattern.samples) {
            if (a != b) {
                nearest = std::min(nearest, std::hypot(a.x - b.x, a.y - b.y));
            }
        }
        sum += nearest * std::sqrt(share);
        ++count;
    }
    return sum / count;
}

TEST(SparsePattern, BlueNoiseSpreadsWhatDrawsClump) {
    const SparseParameters gaussian{.share = 0.04};
    SparseParameters blue = gaussian;
    blue.placement = SparsePlacement::BlueNoise;
    EXPECT_NEAR(relative_spacing(make(gaussian)), 0.52, 0.04);
    EXPECT_GT(relative_spacing(make(blue)), 0.72);
}

TEST(SparsePattern, WindowMovesWithTheGaze) {
    const SparsePattern pattern = make({});
    EXPECT_EQ(pattern.window({210.0, 118.0}), (FieldPixel{210, 118}));
    EXPECT_EQ(pattern.window({0.0, 236.0}), (FieldPixel{420, 0}));
    EXPECT_EQ(pattern.window({210.4, 117.6}), (FieldPixel{210, 118}));
    EXPECT_EQ(pattern.window({-1e30, 1e30}), (FieldPixel{420, 0}));  // at the edge
    // A gaze in the corner sees a quarter of what surrounds it.
    EXPECT_LT(pattern.samples_in({0.0, 0.0}), pattern.samples_in({210.0, 118.0}));
}

TEST(SparsePattern, ExtremeSizes) {
    for (const ImageSize image :
         {ImageSize{1, 1}, ImageSize{2, 1}, ImageSize{1, 300}, ImageSize{4096, 2}}) {
        const SparsePattern pattern = make({}, image);
        EXPECT_EQ(pattern.samples_in({image.width_px / 2.0, image.height_px / 2.0}),
                  std::max<std::uint64_t>(1, static_cast<std::uint64_t>(std::llround(
                                                 0.1 * image.width_px * image.height_px))));
    }
}

TEST(SparsePattern, RefusesWithTheValueAndTheRange) {
    constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
    const auto message = [](const SparseParameters& parameters, ImageSize image = kArticle) {
        const auto pattern = make_sparse_pattern(parameters, image);
        EXPECT_FALSE(pattern.has_value());
        return pattern ? std::string() : pattern.error().message;
    };
    using testing::HasSubstr;
    for (const double bad : {kNan, 0.0, 1.01, -0.1}) {
        EXPECT_THAT(message({.share = bad}), HasSubstr("must lie in [0.001, 1]")) << bad;
    }
    EXPECT_THAT(message({.disc_share = kNan}), HasSubstr("sparse.disc_share = nan"));
    EXPECT_THAT(message({.narrow_share = 1.1}), HasSubstr("sparse.narrow_share = 1.1"));
    EXPECT_THAT(message({.narrow_spread = 0.0}), HasSubstr("sparse.narrow_spread = 0"));
    EXPECT_THAT(message({.wide_spread = 2.1}), HasSubstr("[0.01, 2]"));
    EXPECT_THAT(message({}, {0, 5}), HasSubstr("0x5 px"));
    EXPECT_THAT(message({}, {5, 16385}), HasSubstr("1 to 16384"));
    // Two Gaussians of a hundredth of the diagonal cannot reach half of the picture.
    EXPECT_THAT(message({.share = 0.5, .narrow_spread = 0.01, .wide_spread = 0.01}, {64, 64}),
                HasSubstr("widen sparse.wide_spread = 0.01"));
}

}  // namespace
}  // namespace gazeloop::foveation
