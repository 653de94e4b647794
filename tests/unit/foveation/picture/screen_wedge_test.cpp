#include "runtime/foveation/picture/screen_wedge.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

namespace gazeloop::foveation {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

/// The range over the pixel centres themselves, by looking at every one.
std::optional<RadiusRange> by_every_pixel(ImageSize image, const gaze::PixelPosition& fovea,
                                          double from, double to) {
    std::optional<RadiusRange> range;
    for (std::uint32_t y = 0; y < image.height_px; ++y) {
        for (std::uint32_t x = 0; x < image.width_px; ++x) {
            const double dx = x + 0.5 - fovea.x_px;
            const double dy = y + 0.5 - fovea.y_px;
            double angle = std::atan2(dy, dx);
            while (angle < from) {
                angle += kTurn;
            }
            if (angle > to) {
                continue;
            }
            const double r = std::hypot(dx, dy);
            range = range ? RadiusRange{std::min(range->min_px, r), std::max(range->max_px, r)}
                          : RadiusRange{r, r};
        }
    }
    return range;
}

TEST(ScreenWedge, HoldsEveryPixelCentreAndIsTight) {
    constexpr ImageSize kImage{37, 23};
    std::mt19937 random(7);
    std::uniform_real_distribution<double> x(-60.0, 97.0);
    std::uniform_real_distribution<double> y(-40.0, 63.0);
    std::uniform_real_distribution<double> angle(-std::numbers::pi, std::numbers::pi);
    std::uniform_real_distribution<double> width(0.02, 3.0);
    int seen = 0;
    for (int i = 0; i < 4000; ++i) {
        const gaze::PixelPosition fovea{x(random), y(random)};
        const double from = angle(random);
        const double to = from + width(random);
        const auto exact = by_every_pixel(kImage, fovea, from, to);
        const auto range = screen_radii_in_wedge(kImage, fovea, from, to);
        if (!exact) {
            continue;
        }
        ++seen;
        ASSERT_TRUE(range.has_value()) << fovea.x_px << ' ' << fovea.y_px << ' ' << from;
        EXPECT_LE(range->min_px, exact->min_px + 1e-9);
        EXPECT_GE(range->max_px, exact->max_px - 1e-9);
        // The rectangle's edge lies less than a pixel from centres, seen under the wedge's angle.
        EXPECT_GE(range->max_px, 0.0);
        EXPECT_LE(range->max_px, std::hypot(37 + 60, 23 + 40));
    }
    EXPECT_GT(seen, 1000);
}

TEST(ScreenWedge, FindsTheKnownDistances) {
    constexpr ImageSize kImage{100, 50};
    // To the right of the centre, a thin wedge: out to the last column's centre.
    const auto right = screen_radii_in_wedge(kImage, {50, 25}, -0.001, 0.001);
    ASSERT_TRUE(right.has_value());
    EXPECT_NEAR(right->min_px, 0.0, 1e-12);
    EXPECT_NEAR(right->max_px, 49.5, 1e-3);
    // From outside on the left, looking right: from the first to the last column's centre.
    const auto outside = screen_radii_in_wedge(kImage, {-10, 25}, -0.001, 0.001);
    ASSERT_TRUE(outside.has_value());
    EXPECT_NEAR(outside->min_px, 10.5, 1e-3);
    EXPECT_NEAR(outside->max_px, 109.5, 1e-3);
    // Looking away.
    EXPECT_FALSE(screen_radii_in_wedge(kImage, {-10, 25}, 3.0, 3.2).has_value());
    // All around.
    const auto around = screen_radii_in_wedge(kImage, {0, 0}, 0.0, kTurn);
    ASSERT_TRUE(around.has_value());
    EXPECT_NEAR(around->max_px, std::hypot(99.5, 49.5), 1e-12);
}

}  // namespace
}  // namespace gazeloop::foveation
