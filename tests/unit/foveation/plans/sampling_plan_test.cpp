#include "runtime/foveation/plans/kfr_plan.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "tests/unit/foveation/picture/cells_drawn.h"
#include "tests/unit/foveation/picture/masks.h"

namespace gazeloop::foveation {
namespace {

constexpr double kTurn = 2.0 * std::numbers::pi;

struct Case {
    const char* name;
    KfrParameters parameters;
    ImageSize image;
    gaze::PixelPosition fovea;
    gaze::HiddenMesh mask{};
};

void PrintTo(const Case& at, std::ostream* out) { *out << at.name; }

HiddenArea hidden_of(const Case& at) {
    return {at.mask, tests::square_view(at.image.width_px, at.image.height_px)};
}

LogPolarPlan plan_of(const Case& at) {
    LogPolarPlan plan;
    const HiddenArea hidden = hidden_of(at);
    plan_kfr(at.parameters, value_or_throw(lp_buffer_size(at.parameters, at.image)), at.image,
             at.fovea, plan, at.mask.empty() ? nullptr : &hidden);
    return plan;
}

/// Texels that the bilinear read of some visible pixel outside the disc's core touches with some
/// weight.
std::vector<bool> read_texels(const Case& at, const LogPolarPlan& plan) {
    const LogPolarMap map(at.parameters.kernel, at.image, at.fovea);
    const std::vector<bool> visible = tests::visible_pixels(hidden_of(at), at.image);
    std::vector<bool> read(std::size_t{plan.lp.width} * plan.lp.height, false);
    for (std::uint32_t y = 0; y < at.image.height_px; ++y) {
        for (std::uint32_t x = 0; x < at.image.width_px; ++x) {
            const double dx = x + 0.5 - at.fovea.x_px;
            const double dy = y + 0.5 - at.fovea.y_px;
            const double r = std::hypot(dx, dy);
            if (!visible[std::size_t{y} * at.image.width_px + x]) {
                continue;
            }
            if (plan.disc_radius_px > 0.0 && r <= plan.disc_radius_px - plan.disc_border_px) {
                continue;
            }
            double turns = std::atan2(dy, dx) / kTurn;
            turns -= std::floor(turns);
            const double column = map.u(r) * plan.lp.width - 0.5;
            const double row = turns * plan.lp.height - 0.5;
            for (int i = 0; i < 2; ++i) {
                for (int j = 0; j < 2; ++j) {
                    const auto c = static_cast<std::int64_t>(std::floor(column)) + i;
                    const auto w = static_cast<std::int64_t>(plan.lp.width);
                    const auto h = static_cast<std::int64_t>(plan.lp.height);
                    const std::int64_t v = (static_cast<std::int64_t>(std::floor(row)) + j + h) % h;
                    read[static_cast<std::size_t>(v * w + std::clamp<std::int64_t>(c, 0, w - 1))] =
                        true;
                }
            }
        }
    }
    return read;
}

class SamplingPlans : public testing::TestWithParam<Case> {};

TEST_P(SamplingPlans, ShadeWhatIsReadAndLittleElse) {
    const LogPolarPlan plan = plan_of(GetParam());
    const std::vector<int> shaded =
        cells_drawn(plan.texels.bands, plan.texels.tiles, plan.lp.width, plan.lp.height);
    const std::vector<bool> read = read_texels(GetParam(), plan);
    std::uint64_t needed = 0;
    std::uint64_t covered = 0;
    for (std::size_t i = 0; i < read.size(); ++i) {
        ASSERT_LE(shaded[i], 1) << "texel shaded twice";
        if (read[i]) {
            ++needed;
            ASSERT_EQ(shaded[i], 1)
                << "column " << i % plan.lp.width << " row " << i / plan.lp.width;
        }
        covered += static_cast<std::uint64_t>(shaded[i]);
    }
    EXPECT_EQ(covered, plan.texels.counts.shaded);
    EXPECT_EQ(plan.texels.counts.shaded + plan.texels.counts.off_screen +
                  plan.texels.counts.covered + plan.texels.counts.hidden,
              read.size());
    // Where the buffer is finer than the picture (near the fovea) texels between the read ones are
    // shaded too; elsewhere only the bands' steps are.
    if (plan.disc_radius_px > 0.0 && plan.lp.width > 100) {
        EXPECT_LT(static_cast<double>(covered), 1.35 * static_cast<double>(needed) + 150);
    }
}

TEST_P(SamplingPlans, DiscHoldsEveryVisiblePixelWithinItsRadiusOnce) {
    const Case& at = GetParam();
    const LogPolarPlan plan = plan_of(at);
    const std::vector<bool> visible = tests::visible_pixels(hidden_of(at), at.image);
    const std::vector<int> direct =
        cells_drawn(plan.disc.bands, plan.disc.tiles, at.image.width_px, at.image.height_px);
    EXPECT_EQ(plan.disc.counts.shaded,
              static_cast<std::uint64_t>(std::count(direct.begin(), direct.end(), 1)));
    for (std::uint32_t y = 0; y < at.image.height_px; ++y) {
        for (std::uint32_t x = 0; x < at.image.width_px; ++x) {
            const double r = std::hypot(x + 0.5 - at.fovea.x_px, y + 0.5 - at.fovea.y_px);
            const int count = direct[std::size_t{y} * at.image.width_px + x];
            ASSERT_LE(count, 1);
            if (!visible[std::size_t{y} * at.image.width_px + x]) {
                ASSERT_EQ(count, 0) << x << ' ' << y;
            } else if (r < plan.disc_radius_px - 1e-9) {
                ASSERT_EQ(count, 1) << x << ' ' << y;
            }
        }
    }
}

INSTANTIATE_TEST_SUITE_P(
    Foveae, SamplingPlans,
    testing::Values(Case{"centre", {.kernel = {4}}, {320, 240}, {160, 120}},
                    Case{"centre_no_disc", {.kernel = {4}, .disc = false}, {320, 240}, {160, 120}},
                    Case{"on_a_pixel_centre", {.kernel = {4}}, {320, 240}, {100.5, 60.5}},
                    Case{"left_edge", {.kernel = {4}}, {320, 240}, {0, 120}},
                    Case{"corner", {.kernel = {4}}, {320, 240}, {320, 240}},
                    Case{"off_screen_left", {.kernel = {4}}, {320, 240}, {-80, 120}},
                    Case{"off_screen_below", {.kernel = {4}}, {320, 240}, {200, 900}},
                    Case{"far_off_screen", {.kernel = {4}}, {320, 240}, {-640, -480}},
                    Case{"classic_log_polar", {.kernel = {1}}, {320, 240}, {170, 90}},
                    Case{"alpha_small", {.kernel = {0.25}}, {320, 240}, {170, 90}},
                    Case{"alpha_large", {.kernel = {16}}, {320, 240}, {170, 90}},
                    Case{"sigma_small", {.sigma = 0.5, .kernel = {4}}, {160, 120}, {70, 50}},
                    Case{"sigma_large", {.sigma = 16, .kernel = {4}}, {320, 240}, {170, 90}},
                    Case{"coarsest", {.sigma = 32, .kernel = {2}}, {320, 240}, {170, 90}},
                    Case{"smallest", {.sigma = 0.5, .kernel = {4}}, {2, 2}, {1, 1}},
                    Case{"no_border", {.kernel = {4}, .border_px = 0}, {320, 240}, {160, 120}},
                    Case{"flat", {.sigma = 1, .kernel = {4}}, {700, 4}, {350, 2}}),
    [](const auto& instance) { return instance.param.name; });

INSTANTIATE_TEST_SUITE_P(
    Masks, SamplingPlans,
    testing::Values(
        Case{"octagon", {.kernel = {4}}, {320, 240}, {160, 120}, tests::cut_corners(0.125)},
        Case{"octagon_from_a_corner", {.kernel = {4}}, {320, 240}, {5, 7}, tests::cut_corners(0.3)},
        Case{"ellipse", {.kernel = {4}}, {320, 240}, {150, 100}, tests::outside_ellipse(0.9, 64)},
        Case{"ellipse_seen_from_outside",
             {.kernel = {4}},
             {320, 240},
             {-80, 300},
             tests::outside_ellipse(0.8, 64)},
        Case{"ellipse_no_disc",
             {.kernel = {1}, .disc = false},
             {320, 240},
             {100, 180},
             tests::outside_ellipse(0.95, 24)},
        Case{"small_hole", {.kernel = {4}}, {320, 240}, {20, 20}, tests::outside_ellipse(0.1, 32)},
        Case{"left_half", {.kernel = {4}}, {320, 240}, {40, 120}, tests::left_of(0.0)}),
    [](const auto& instance) { return instance.param.name; });

TEST(LogPolarPlan, LeavesOutWhatOnlyHiddenPixelsRead) {
    const KfrParameters kfr{.sigma = 1.8, .kernel = {4}};
    const Case open{"", kfr, {1280, 1440}, {640, 720}};
    Case masked = open;
    masked.mask = tests::outside_ellipse(1.0, 64);
    const LogPolarPlan whole = plan_of(open);
    const LogPolarPlan plan = plan_of(masked);
    EXPECT_EQ(whole.texels.counts.hidden, 0U);
    EXPECT_EQ(plan.texels.counts.off_screen, whole.texels.counts.off_screen);
    EXPECT_EQ(plan.texels.counts.shaded + plan.texels.counts.hidden, whole.texels.counts.shaded);
    // The corners are 21.5 % of the pixels, and the texels out there are few.
    const double share = static_cast<double>(plan.texels.counts.hidden) /
                         static_cast<double>(whole.texels.counts.shaded);
    EXPECT_GT(share, 0.05);
    EXPECT_LT(share, 0.215);
}

// Figures of a prototype and of the reference, variant B, alpha 4, sigma 1.8, without disc.
TEST(LogPolarPlan, CountsTheTexelsOnScreen) {
    const KfrParameters plain{.sigma = 1.8, .kernel = {4}, .disc = false};
    const auto share = [&](double x, double y) {
        const LogPolarPlan plan = plan_of({"", plain, {1920, 1080}, {x, y}});
        return static_cast<double>(plan.texels.counts.shaded) / (1067.0 * 600.0);
    };
    EXPECT_NEAR(share(960, 540), 524252.0 / 640200.0, 0.01);
    EXPECT_NEAR(share(0, 540), .34, .01);
    EXPECT_NEAR(share(0, 0), .21, .01);
    EXPECT_NEAR(share(-480, 540), .09, .01);
}

TEST(LogPolarPlan, ReplacesTexelsByFewerPixels) {
    const KfrParameters kfr{.sigma = 1.8, .kernel = {4}};
    const LogPolarPlan plan = plan_of({"", kfr, {1920, 1080}, {960, 540}});
    EXPECT_NEAR(static_cast<double>(plan.disc.counts.shaded), 65000.0, 2000.0);
    EXPECT_NEAR(static_cast<double>(plan.texels.counts.covered), 161000.0, 12000.0);
}

TEST(LogPolarPlan, NeedsNoLpBufferWhereTheDiscCoversTheScreen) {
    const LogPolarPlan plan = plan_of({"", {.sigma = 0.5, .kernel = {4}}, {16, 16}, {8, 8}});
    EXPECT_TRUE(plan.texels.tiles.empty());
    EXPECT_EQ(plan.disc.counts.shaded, 256U);
    EXPECT_EQ(plan.texels.counts.shaded, 0U);
}

TEST(LogPolarPlan, ReusesItsMemory) {
    const KfrParameters kfr{.sigma = 1.8, .kernel = {4}};
    const ImageSize image{640, 480};
    const LpSize lp = value_or_throw(lp_buffer_size(kfr, image));
    LogPolarPlan plan;
    plan_kfr(kfr, lp, image, {320, 240}, plan);
    const Tile* const tiles = plan.texels.tiles.data();
    plan_kfr(kfr, lp, image, {10, 20}, plan);
    EXPECT_EQ(plan.texels.tiles.data(), tiles);
}

}  // namespace
}  // namespace gazeloop::foveation
