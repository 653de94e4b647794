// The traps that log-polar maps in float fall into, each with what keeps this library out of it.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "runtime/foveation/log_polar/degenerate_map.h"
#include "runtime/foveation/log_polar/float_map.h"
#include "runtime/foveation/log_polar/map_error.h"
#include "runtime/foveation/plans/kfr_plan.h"

namespace gazeloop::foveation {
namespace {

/// One map in the picture's frame, exact and as the shader has it.
struct Pair {
    LpSize lp;
    LogPolarMap exact;
    MapTables tables;
    FloatMap mirror;

    Pair(const RadialKernel& kernel, ImageSize image, const gaze::PixelPosition& fovea, LpSize size)
        : lp(size),
          exact(kernel, image, fovea),
          tables(build_map_tables(kernel, size)),
          mirror(tables, size, picture_frame_uniforms(fovea, exact.log2_max_radius())) {}
    Pair(const Pair&) = delete;
    Pair& operator=(const Pair&) = delete;
    ~Pair() = default;

    /// How far the position that the shares of a pixel stand for is from it.
    [[nodiscard]] double error_px(double x, double y) const {
        const FloatMap::Share share = mirror.share({static_cast<float>(x), static_cast<float>(y)});
        const gaze::PixelPosition back = exact.position({share.u, share.v}).value();
        return std::hypot(back.x_px - x, back.y_px - y);
    }
};

// ln r < 0 within a pixel of the fovea: fractional powers of it are no numbers, whole ones alias.
TEST(MapTrap, RadiiUnderAPixelHaveNoLogarithm) {
    for (const double alpha : {0.25, 0.5, 2.0, 3.7, 4.0}) {
        const Pair map(alpha, {1920, 1080}, {960, 540}, {1067, 600});
        for (const float dx : {-0.5F, 0.0F, 0.1F, 0.9F}) {
            for (const float dy : {-0.4F, 0.0F, 0.3F}) {
                const FloatMap::Share share = map.mirror.share({960.0F + dx, 540.0F + dy});
                EXPECT_LT(share.u, 1e-3F) << alpha << ' ' << dx << ' ' << dy;
                EXPECT_GE(share.u, 0.0F) << alpha << ' ' << dx << ' ' << dy;
            }
        }
        EXPECT_EQ(map.exact.u(0.9), 0.0);
    }
}

// L <= 0: a picture with no radius beyond a pixel.
TEST(MapTrap, PicturesOfOnePixelAreRefused) {
    for (const ImageSize image : {ImageSize{0, 0}, ImageSize{1, 1}, ImageSize{1, 9}}) {
        EXPECT_FALSE(lp_buffer_size({.sigma = 0.5, .kernel = {}}, image).has_value());
    }
    EXPECT_GT(LogPolarMap(4.0, {2, 2}, {1, 1}).log2_max_radius(), 0.0);
}

// L changes with the gaze; what is off screen is not shaded.
TEST(MapTrap, TheFarthestRadiusFollowsTheGaze) {
    const RadialKernel kernel;
    const MapTables tables = build_map_tables(kernel, {711, 400});
    for (const gaze::PixelPosition fovea : {gaze::PixelPosition{640, 360}, {0, 0}, {-1280, 2160}}) {
        const LogPolarMap exact(kernel, {1280, 720}, fovea);
        const FloatMap mirror(tables, {711, 400},
                              picture_frame_uniforms(fovea, exact.log2_max_radius()));
        const double far_x = fovea.x_px < 640 ? 1279.5 : 0.5;
        const double far_y = fovea.y_px < 360 ? 719.5 : 0.5;
        const LpShare share = exact.share({far_x, far_y});
        EXPECT_NEAR(mirror.share({static_cast<float>(far_x), static_cast<float>(far_y)}).u, share.u,
                    1e-6);
        EXPECT_GT(share.u, 0.99);
    }
}

// atan(y / x) folds the picture, atan(0, 0) is undefined, -0 and -1e-8 lie beside the wrap.
TEST(MapTrap, AnglesGoOnceAroundAndWrap) {
    const Pair map(4.0, {640, 480}, {320, 240}, {320, 240});
    const auto v = [&](float dx, float dy) {
        return map.mirror.share({320.0F + dx, 240.0F + dy}).v;
    };
    EXPECT_EQ(v(0.0F, 0.0F), 0.0F);
    EXPECT_EQ(v(100.0F, 0.0F), 0.0F);
    EXPECT_FLOAT_EQ(v(100.0F, 100.0F), 0.125F);
    EXPECT_FLOAT_EQ(v(-100.0F, 100.0F), 0.375F);
    EXPECT_FLOAT_EQ(v(-100.0F, -100.0F), 0.625F);
    EXPECT_FLOAT_EQ(v(100.0F, -100.0F), 0.875F);
    const Pair at_zero(4.0, {640, 480}, {0, 0}, {320, 240});
    EXPECT_EQ(at_zero.mirror.share({100.0F, -0.0F}).v, 0.0F);
    const float before = at_zero.mirror.share({100.0F, -1e-8F}).v;
    EXPECT_GE(before, 0.99999F);
    EXPECT_LE(before, 1.0F);  // 1 is row 0 again: the sampler repeats
    EXPECT_LT(at_zero.exact.share({100.0, -1e-300}).v, 1.0);
}

// Rows wrap, columns end: texels on both sides of the seam are in the plan.
TEST(MapTrap, TheSeamsRowsAreBothPlanned) {
    const KfrParameters kfr{.sigma = 2.0, .kernel = {4}, .disc = false};
    const LpSize lp = value_or_throw(lp_buffer_size(kfr, {320, 240}));
    LogPolarPlan plan;
    plan_kfr(kfr, lp, {320, 240}, {160.0, 120.0}, plan);
    bool first = false;
    bool last = false;
    for (const Tile& tile : plan.texels.tiles) {
        first = first || (tile.y0 == 0 && tile.x1 > lp.width / 2);
        last = last || (tile.y1 == lp.height && tile.x1 > lp.width / 2);
    }
    EXPECT_TRUE(first && last);
}

// Half a texel: centres, not edges, are tabulated and placed.
TEST(MapTrap, TexelsStandForTheirCentres) {
    const Pair map(4.0, {1280, 1440}, {600, 700}, {711, 800});
    for (const std::uint32_t column : {0U, 1U, 300U, 710U}) {
        for (const std::uint32_t row : {0U, 399U, 799U}) {
            const glm::vec2 placed = map.mirror.position(column, row);
            const gaze::PixelPosition exact =
                map.exact.position({(column + 0.5) / 711, (row + 0.5) / 800}).value();
            EXPECT_NEAR(placed.x, exact.x_px, 2e-3) << column << ' ' << row;
            EXPECT_NEAR(placed.y, exact.y_px, 2e-3) << column << ' ' << row;
        }
    }
}

// Drivers may be off by 2^-11 in sin and cos and by 4096 units in atan2: up to 11 px at 16384. The
// row table and the polynomial are not.
TEST(MapTrap, DirectionsDoNotComeFromTheDriver) {
    const Pair map(4.0, {16384, 16384}, {0, 0}, {9102, 9102});
    for (const std::uint32_t row : {0U, 1000U, 2275U}) {
        const glm::vec2 placed = map.mirror.position(9101, row);
        const gaze::PixelPosition exact =
            map.exact.position({9101.5 / 9102, (row + 0.5) / 9102}).value();
        EXPECT_NEAR(placed.x, exact.x_px, 0.02);
        EXPECT_NEAR(placed.y, exact.y_px, 0.02);
    }
    for (const double angle : {0.01, 0.5, 0.7853, 1.2, 1.57}) {
        EXPECT_LT(map.error_px(16000 * std::cos(angle), 16000 * std::sin(angle)), 0.02) << angle;
    }
}

// Logarithms of r^2 itself leave 1e-6 of r; of the share of the greatest radius they leave less
// where r is great. And a kernel with a flat end has no finite slope for uniform steps to follow.
TEST(MapTrap, TheFarEndIsTheFinest) {
    const Pair far(4.0, {16384, 16384}, {-32768, -32768}, {9102, 9102});
    for (const double share : {0.2, 0.5, 0.8, 0.999}) {
        EXPECT_LT(far.error_px(std::floor(16384 * share) + 0.5, std::floor(16000 * share) + 0.5),
                  0.03)
            << share;
    }
    const Pair sine(RadialKernel(SineKernel{}), {4096, 4096}, {2048, 2048}, {2276, 2276});
    const double last_centre = sine.exact.radius_px(1.0 - 0.5 / 2276);
    for (double r = 100; r < last_centre; r += 97) {
        const double y = 2048 - r * std::numbers::sqrt2 / 2;
        const double x = 2048 - r * std::numbers::sqrt2 / 2;
        EXPECT_LT(sine.error_px(static_cast<float>(x), static_cast<float>(y)), 0.02) << r;
    }
}

// Half floats for (u, v) would be off by pixels.
TEST(MapTrap, SharesAreFloatsNotHalves) {
    static_assert(sizeof(FloatMap::Share::u) == 4);
    const LogPolarMap map(4.0, {2560, 1440}, {1280, 720});
    const LpShare share = map.share({200.5, 90.5});
    const double half_step = std::ldexp(1.0, -11);  // of a half float below 1
    EXPECT_GT(map.radius_px(share.u + half_step) - map.radius_px(share.u), 1.0);
    EXPECT_LT(MapError::conditioning_px(map, {200.5, 90.5}), 2e-3);
}

// The hole of the power kernel: fewer than a column a pixel around the fovea.
TEST(MapTrap, TheHoleIsClosedOnRequest) {
    const KfrParameters open{.sigma = 1.8, .kernel = {4}, .disc = false};
    KfrParameters closed = open;
    closed.close_hole = true;
    const ImageSize image{1280, 1440};
    const LpSize lp = value_or_throw(lp_buffer_size(open, image));
    const LogPolarMap map(4.0, image, {640, 720});
    EXPECT_LT(map.density(2.0, lp).radial, 0.6);
    LogPolarPlan plan;
    plan_kfr(open, lp, image, {640, 720}, plan);
    EXPECT_EQ(plan.disc.counts.shaded, 0U);
    const std::uint64_t texels = plan.texels.counts.shaded;
    plan_kfr(closed, lp, image, {640, 720}, plan);
    ASSERT_GT(plan.disc_radius_px, plan.disc_border_px);
    EXPECT_LT(plan.disc.counts.shaded, 400U);  // no full pass: a thousandth of the texels
    for (double r = plan.disc_radius_px - plan.disc_border_px; r < 100.0; r *= 1.01) {
        EXPECT_GE(map.density(r, lp).radial, 0.999) << r;
    }
    EXPECT_LE(plan.texels.counts.shaded, texels);
}

// Parameters that leave nothing to draw, however exact the arithmetic.
TEST(MapTrap, AMapThatShowsNothingIsCalledUseless) {
    const ImageSize image{1280, 1440};
    const LpSize coarse{40, 45};  // sigma 32
    EXPECT_EQ(why_degenerate(LogPolarMap(16.0, image, {1280, 1440}), coarse, 0.0),
              "the first column reaches 406 px from the fovea");
    EXPECT_EQ(
        why_degenerate(LogPolarMap(PrintedPowerKernel{16.0}, image, {1280, 1440}), coarse, 0.0)
            .substr(0, 18),
        "the last column is");
    EXPECT_EQ(why_degenerate(LogPolarMap(4.0, image, {640, 720}), {711, 800}, 0.0), "");
    // What the disc covers is not shown.
    EXPECT_EQ(why_degenerate(LogPolarMap(16.0, image, {1280, 1440}), coarse, 407.0), "");
}

TEST(MapError, BoundsWhatTheMirrorDoes) {
    for (const RadialKernel& kernel :
         {RadialKernel(0.25), RadialKernel(4.0), RadialKernel(16.0), RadialKernel(SineKernel{})}) {
        const Pair map(kernel, {4096, 4096}, {1000.3, 2000.7}, {2276, 2276});
        const MapError error(kernel);
        for (double y = 0.5; y < 4096; y += 113) {
            for (double x = 0.5; x < 4096; x += 127) {
                const double column = map.exact.share({x, y}).u * map.lp.width;
                if (column >= 0.5 && column <= map.lp.width - 0.5) {
                    ASSERT_LE(map.error_px(x, y), error.forward_px(map.exact, {x, y}))
                        << kernel.description() << ' ' << x << ' ' << y;
                }
            }
        }
    }
}

}  // namespace
}  // namespace gazeloop::foveation
