#include "runtime/foveation/log_polar/acuity_map.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/gtc/quaternion.hpp>
#include <limits>
#include <numbers>
#include <vector>

#include "runtime/foveation/plans/acuity_plan.h"
#include "tests/unit/foveation/picture/cells_drawn.h"
#include "tests/unit/foveation/picture/masks.h"

namespace gazeloop::foveation {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;
constexpr double kTurn = 2.0 * std::numbers::pi;

gaze::EyeView square_view(std::uint32_t side, double half_deg = 50.0) {
    const double half = half_deg * kDegree;
    return {.fov = {-half, half, half, -half}, .width_px = side, .height_px = side};
}

/// Small, wide and asymmetric.
gaze::EyeView lopsided_view() {
    return {.fov = {-55 * kDegree, 35 * kDegree, 40 * kDegree, -52 * kDegree},
            .width_px = 160,
            .height_px = 140};
}

glm::dvec3 gaze_at(double azimuth_deg, double elevation_deg) {
    const double a = azimuth_deg * kDegree;
    const double e = elevation_deg * kDegree;
    return {std::sin(a) * std::cos(e), std::sin(e), -std::cos(a) * std::cos(e)};
}

// Sizes for a display's density at its centre: 290 columns within 59.3 degrees, 534 rows.
TEST(AcuityProfile, HasThePublishedSize) {
    const gaze::EyeView view = square_view(2160);
    const double p = pixels_per_degree(view, {0, 0, -1}).finest;
    EXPECT_NEAR(p, 15.8, 0.05);
    const auto profile = value_or_throw(AcuityProfile::create({.pixels_per_degree = p}, view));
    const double corner_deg = std::atan(std::tan(50 * kDegree) * std::numbers::sqrt2) / kDegree;
    EXPECT_NEAR(profile.columns(corner_deg), 290.0, 1.0);
    EXPECT_EQ(profile.lp().height, 534U);
    EXPECT_NEAR(profile.display_limit_deg(), 4.8, 0.05);
    const auto finer =
        value_or_throw(AcuityProfile::create({.mar = {.slope = 0.0275}}, square_view(2160)));
    EXPECT_EQ(finer.lp().height, 431U);
}

TEST(AcuityProfile, IsSmoothAndInverts) {
    for (const double p : {5.0, 15.8, 60.0, 200.0}) {
        for (const double slope : {1e-6, 0.001, 0.022, 1.0}) {
            const auto profile = value_or_throw(AcuityProfile::create(
                {.mar = {.slope = slope},
                 .pixels_per_degree = p,
                 .lp_width = 100,  // the flattest line asks for more than a device holds
                 .lp_height = 100},
                square_view(1000)));
            for (double e = 1e-6; e < 179.0; e *= 1.3) {
                EXPECT_NEAR(profile.eccentricity_deg(profile.columns(e)) / e, 1.0, 1e-12);
                const double h = 1e-6 * e;
                EXPECT_NEAR((profile.columns(e + h) - profile.columns(e - h)) / (2 * h) /
                                profile.columns_per_degree(e),
                            1.0, 1e-5);
                // As dense as the line or the display asks for, whichever is less.
                EXPECT_NEAR(
                    profile.columns_per_degree(e) / std::min(p, 2.0 / profile.mar().omega_deg(e)),
                    1.0, 1e-12);
            }
        }
    }
}

struct Refused {
    const char* name;
    AcuityParameters parameters;
    gaze::EyeView view;
    const char* message;
};
void PrintTo(const Refused& at, std::ostream* out) { *out << at.name; }
class AcuityRefuses : public testing::TestWithParam<Refused> {};

TEST_P(AcuityRefuses, WithTheValueAndTheRange) {
    const auto profile = AcuityProfile::create(GetParam().parameters, GetParam().view);
    ASSERT_FALSE(profile.has_value());
    EXPECT_EQ(profile.error().kind, ErrorKind::Usage);
    EXPECT_NE(profile.error().message.find(GetParam().message), std::string::npos)
        << profile.error().message;
}

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
INSTANTIATE_TEST_SUITE_P(
    BadInput, AcuityRefuses,
    testing::Values(
        Refused{"slope_zero", {.mar = {.slope = 0}}, square_view(100), "slope m = 0: must lie"},
        Refused{"slope_negative", {.mar = {.slope = -0.02}}, square_view(100), "[1e-06, 1]"},
        Refused{"slope_nan", {.mar = {.slope = kNan}}, square_view(100), "slope m = nan"},
        Refused{"omega", {.mar = {.omega0_deg = 0}}, square_view(100), "omega0 = 0 degrees"},
        Refused{"density", {.pixels_per_degree = kNan}, square_view(100), "per_degree = nan"},
        Refused{"border", {.border_px = 65}, square_view(100), "acuity.border_px = 65"},
        Refused{"one_pixel", {}, square_view(1), "1x1 px"},
        Refused{"no_pixels", {}, square_view(0), "0x0 px"},
        Refused{"no_view", {}, square_view(100, 0.0), "a field of view"},
        Refused{"half_a_turn", {}, square_view(100, 90.0), "a field of view"},
        Refused{"flat",
                {.mar = {.slope = 1e-6}, .pixels_per_degree = 60},
                square_view(100),
                "10740x21600 texels"},
        Refused{"too_wide", {.lp_width = 20000}, square_view(100), "20000x"},
        Refused{"too_low", {.lp_height = 3}, square_view(100), "it must have 2x4"}),
    [](const auto& instance) { return instance.param.name; });

// A circle of eccentricity is none in pixels: at 30 degrees off axis, 20 degrees are 13.3 outward
// and 18.0 inward by the flat rule r = d tan e.
TEST(GazeFrame, MeasuresAnglesNotPixels) {
    const gaze::EyeView view = square_view(2000);
    const double per_tangent = 1000.0 / std::tan(50 * kDegree);
    const GazeFrame frame(view, gaze_at(30, 0));
    const double gaze_x = 1000 + per_tangent * std::tan(30 * kDegree);
    const double flat = per_tangent * std::tan(20 * kDegree);
    EXPECT_NEAR(frame.eccentricity_rad({gaze_x + flat, 1000}) / kDegree, 13.3, 0.1);
    EXPECT_NEAR(frame.eccentricity_rad({gaze_x - flat, 1000}) / kDegree, 18.0, 0.1);
    EXPECT_NEAR(frame.eccentricity_rad({gaze_x, 1000}), 0.0, 1e-12);
}

TEST(GazeFrame, IsARotationThatTurnsWithTheScreen) {
    for (const glm::dvec3& gaze : {gaze_at(0, 0), gaze_at(30, -20), gaze_at(-100, 10),
                                   gaze_at(179.9, 0), glm::dvec3(0, 0, 1), glm::dvec3(0)}) {
        const GazeFrame frame(lopsided_view(), gaze);
        const glm::dmat3& axes = frame.view_from_gaze();
        const glm::dmat3 unit = glm::transpose(axes) * axes;
        for (int i = 0; i < 3; ++i) {
            for (int j = 0; j < 3; ++j) {
                EXPECT_NEAR(unit[i][j], i == j ? 1.0 : 0.0, 1e-9);
            }
        }
        EXPECT_NEAR(glm::determinant(axes), 1.0, 1e-9);
    }
    // Straight ahead: right is a quarter of a turn from down.
    const GazeFrame ahead(square_view(100), gaze_at(0, 0));
    EXPECT_NEAR(ahead.polar({80, 50}).angle_rad, 0.0, 1e-12);
    EXPECT_NEAR(ahead.polar({50, 80}).angle_rad, kTurn / 4, 1e-12);
}

std::vector<glm::dvec3> gazes() {
    return {gaze_at(0, 0),   gaze_at(-20, 10), gaze_at(35, 40),   gaze_at(34.9, -51.9),
            gaze_at(60, 0),  gaze_at(-80, 30), gaze_at(88, -10),  gaze_at(100, 20),
            gaze_at(-55, 0), gaze_at(150, -5), gaze_at(0.01, 70), glm::dvec3(0, 0, 1)};
}

TEST(AcuityMap, GoesThereAndBack) {
    const gaze::EyeView view = lopsided_view();
    const auto profile = value_or_throw(AcuityProfile::create({}, view));
    for (const glm::dvec3& gaze : gazes()) {
        const AcuityMap map(profile, GazeFrame(view, gaze));
        for (double y = 0.5; y < view.height_px; y += 7) {
            for (double x = 0.5; x < view.width_px; x += 7) {
                const LpShare share = map.share({x, y});
                ASSERT_TRUE(share.u >= 0 && share.u <= 1 && share.v >= 0 && share.v < 1);
                if (share.u == 1.0) {
                    continue;  // within a degree of straight behind the gaze
                }
                const auto back = map.position(share);
                ASSERT_TRUE(back.has_value()) << gaze.x << ' ' << x << ' ' << y;
                EXPECT_NEAR(back->x_px, x, 1e-7);
                EXPECT_NEAR(back->y_px, y, 1e-7);
            }
        }
    }
}

TEST(GazeFrame, FindsWhatOfAWedgeIsOnScreen) {
    const gaze::EyeView view = lopsided_view();
    for (const glm::dvec3& gaze : gazes()) {
        const GazeFrame frame(view, gaze);
        for (const double width : {0.05, 0.4, 2.9, kTurn}) {
            for (double from = -0.3; from < 6.0; from += 0.37) {
                double least = std::numeric_limits<double>::infinity();
                double most = -1.0;
                for (double y = 0.5; y < view.height_px; ++y) {
                    for (double x = 0.5; x < view.width_px; ++x) {
                        const GazePolar polar = frame.polar({x, y});
                        const double past = std::remainder(polar.angle_rad - from, kTurn);
                        if ((past < 0.0 ? past + kTurn : past) <= width) {
                            least = std::min(least, polar.rho);
                            most = std::max(most, polar.rho);
                        }
                    }
                }
                const auto range = frame.on_screen(from, from + width);
                if (most < 0.0) {
                    continue;
                }
                ASSERT_TRUE(range.has_value()) << gaze.x << ' ' << from << ' ' << width;
                EXPECT_LE(range->min, least * (1 + 1e-9));
                EXPECT_GE(range->max, most * (1 - 1e-9));
                // Tight, for the corners are pixel centres; unless the point opposite of the gaze
                // lies on screen, between them.
                if (width == kTurn && std::isfinite(range->max)) {
                    EXPECT_NEAR(range->max, most, 1e-3 * most);
                }
            }
        }
    }
}

TEST(GazeFrame, FindsTheRowsOfADisc) {
    const gaze::EyeView view = lopsided_view();
    for (const glm::dvec3& gaze : gazes()) {
        const GazeFrame frame(view, gaze);
        for (const double e_deg : {0.5, 5.0, 30.0, 70.0, 89.0}) {
            for (double y = 0.5; y < view.height_px; y += 3) {
                const auto span = frame.row_within(y, e_deg * kDegree);
                for (double x = 0.5; x < view.width_px; ++x) {
                    const double e = frame.eccentricity_rad({x, y}) / kDegree;
                    const bool inside = span && x >= span->from_x_px && x <= span->to_x_px;
                    if (std::abs(e - e_deg) > 1e-6) {
                        ASSERT_EQ(inside, e < e_deg)
                            << gaze.x << ',' << gaze.y << ' ' << e_deg << ' ' << x << ' ' << y;
                    }
                }
            }
        }
    }
}

struct Planned {
    const char* name;
    bool disc;
    gaze::HiddenMesh mask;
};
void PrintTo(const Planned& at, std::ostream* out) { *out << at.name; }
class AcuityPlans : public testing::TestWithParam<Planned> {};

TEST_P(AcuityPlans, ShadeWhatIsReadAndLittleElse) {
    const gaze::EyeView view = lopsided_view();
    const AcuityParameters parameters{.disc = GetParam().disc};
    const auto profile = value_or_throw(AcuityProfile::create(parameters, view));
    const HiddenArea hidden(GetParam().mask, view);
    const std::vector<bool> visible =
        tests::visible_pixels(hidden, {view.width_px, view.height_px});
    for (const glm::dvec3& gaze : gazes()) {
        SCOPED_TRACE(testing::Message() << gaze.x << ' ' << gaze.y << ' ' << gaze.z);
        LogPolarPlan plan;
        plan_acuity(parameters, profile, view, gaze, plan,
                    GetParam().mask.empty() ? nullptr : &hidden);
        ASSERT_TRUE(plan.in_gaze_frame.has_value());
        const double disc = plan.in_gaze_frame->disc_half_sine;
        const double core = disc - plan.in_gaze_frame->border_half_sine;
        const std::size_t w = plan.lp.width;
        const std::size_t h = plan.lp.height;
        const AcuityMap map(profile, GazeFrame(view, gaze));
        std::vector<bool> read(w * h, false);
        const std::vector<int> direct =
            cells_drawn(plan.disc.bands, plan.disc.tiles, view.width_px, view.height_px);
        for (std::uint32_t y = 0; y < view.height_px; ++y) {
            for (std::uint32_t x = 0; x < view.width_px; ++x) {
                const gaze::PixelPosition at{x + 0.5, y + 0.5};
                const double half_sine = std::sin(0.5 * map.frame().eccentricity_rad(at));
                const int count = direct[std::size_t{y} * view.width_px + x];
                ASSERT_LE(count, 1);
                if (!visible[std::size_t{y} * view.width_px + x]) {
                    ASSERT_EQ(count, 0);
                    continue;
                }
                if (parameters.disc && half_sine < disc) {
                    ASSERT_EQ(count, 1) << x << ' ' << y;
                }
                if (parameters.disc && half_sine <= core) {
                    continue;
                }
                const LpShare share = map.share(at);
                const auto column =
                    static_cast<std::int64_t>(std::floor(share.u * static_cast<double>(w) - 0.5));
                const auto row =
                    static_cast<std::int64_t>(std::floor(share.v * static_cast<double>(h) - 0.5));
                for (const std::int64_t c : {column, column + 1}) {
                    for (const std::int64_t r : {row, row + 1}) {
                        const auto wrapped =
                            (r + static_cast<std::int64_t>(h)) % static_cast<std::int64_t>(h);
                        const auto clamped =
                            std::clamp<std::int64_t>(c, 0, static_cast<std::int64_t>(w) - 1);
                        read[static_cast<std::size_t>(wrapped) * w +
                             static_cast<std::size_t>(clamped)] = true;
                    }
                }
            }
        }
        const std::vector<int> shaded =
            cells_drawn(plan.texels.bands, plan.texels.tiles, plan.lp.width, plan.lp.height);
        std::uint64_t covered = 0;
        for (std::size_t i = 0; i < read.size(); ++i) {
            ASSERT_LE(shaded[i], 1);
            ASSERT_TRUE(!read[i] || shaded[i] == 1) << "column " << i % w << " row " << i / w;
            covered += static_cast<std::uint64_t>(shaded[i]);
        }
        EXPECT_EQ(covered, plan.texels.counts.shaded);
        EXPECT_EQ(plan.texels.counts.shaded + plan.texels.counts.off_screen +
                      plan.texels.counts.covered + plan.texels.counts.hidden,
                  w * h);
        if (!GetParam().mask.empty()) {
            LogPolarPlan whole;
            plan_acuity(parameters, profile, view, gaze, whole);
            EXPECT_EQ(whole.texels.counts.hidden, 0U);
            EXPECT_LE(plan.texels.counts.shaded, whole.texels.counts.shaded);
            EXPECT_EQ(plan.texels.counts.off_screen, whole.texels.counts.off_screen);
        }
    }
}

INSTANTIATE_TEST_SUITE_P(Masks, AcuityPlans,
                         testing::Values(Planned{"disc", true, {}}, Planned{"no_disc", false, {}},
                                         Planned{"disc_in_an_ellipse", true,
                                                 tests::outside_ellipse(0.7, 32)},
                                         Planned{"ellipse", false, tests::outside_ellipse(0.7, 32)},
                                         Planned{"left_half", true, tests::left_of(0.0)}),
                         [](const auto& instance) { return instance.param.name; });

// As for KFR: the corners are 21.5 % of the pixels, and the texels out there are few.
TEST(AcuityPlan, LeavesOutWhatOnlyHiddenPixelsRead) {
    const gaze::EyeView view = square_view(2160, 45.0);
    const AcuityParameters parameters;
    const auto profile = value_or_throw(AcuityProfile::create(parameters, view));
    const HiddenArea hidden(tests::outside_ellipse(1.0, 64), view);
    LogPolarPlan whole;
    plan_acuity(parameters, profile, view, {0, 0, -1}, whole);
    LogPolarPlan plan;
    plan_acuity(parameters, profile, view, {0, 0, -1}, plan, &hidden);
    EXPECT_EQ(plan.texels.counts.shaded + plan.texels.counts.hidden, whole.texels.counts.shaded);
    const double share = static_cast<double>(plan.texels.counts.hidden) /
                         static_cast<double>(whole.texels.counts.shaded);
    EXPECT_GT(share, 0.02);
    EXPECT_LT(share, 0.215);
    // Looking at a corner that nobody sees: most of what is dear is hidden.
    plan_acuity(parameters, profile, view, {1, 1, -1}, whole);
    plan_acuity(parameters, profile, view, {1, 1, -1}, plan, &hidden);
    EXPECT_LT(plan.texels.counts.shaded + plan.disc.counts.shaded,
              0.8 * static_cast<double>(whole.texels.counts.shaded + whole.disc.counts.shaded));
}

// The figures a prototype reached: 149910 of 154860 texels on screen without the disc.
// For pictures and previews: the ring is where the disc ends.
TEST(AcuityPlan, SaysHowLargeTheDiscLooks) {
    const gaze::EyeView view = square_view(2160, 45.0);
    const AcuityParameters parameters;
    const auto profile = value_or_throw(AcuityProfile::create(parameters, view));
    LogPolarPlan plan;
    plan_acuity(parameters, profile, view, {0, 0, -1}, plan);
    ASSERT_GT(plan.disc_radius_px, 10.0);
    EXPECT_NEAR(std::sqrt(static_cast<double>(plan.disc.counts.shaded) / std::numbers::pi),
                plan.disc_radius_px, 0.06 * plan.disc_radius_px)
        << "a little more than the disc: bands are as wide as their widest row";
    plan_acuity({.disc = false}, profile, view, {0, 0, -1}, plan);
    EXPECT_EQ(plan.disc_radius_px, 0.0);
}

TEST(AcuityPlan, NeedsAFewPercentOfThePixels) {
    const gaze::EyeView view = square_view(2160);
    const double p = pixels_per_degree(view, {0, 0, -1}).finest;
    const AcuityParameters plain{.pixels_per_degree = p, .disc = false};
    const auto profile = value_or_throw(AcuityProfile::create(plain, view));
    LogPolarPlan plan;
    plan_acuity(plain, profile, view, {0, 0, -1}, plan);
    EXPECT_NEAR(static_cast<double>(plan.texels.counts.shaded), 149910.0, 3000.0);
    // Tables for every gaze shade no more than tables for this one, once the disc is there.
    const auto shaded = [&](double pixels_per_degree) {
        const AcuityParameters parameters{.pixels_per_degree = pixels_per_degree};
        LogPolarPlan with_disc;
        plan_acuity(parameters, value_or_throw(AcuityProfile::create(parameters, view)), view,
                    {0, 0, -1}, with_disc);
        return static_cast<double>(with_disc.texels.counts.shaded + with_disc.disc.counts.shaded);
    };
    EXPECT_NEAR(shaded(0.0) / shaded(p), 1.0, 0.02);
    EXPECT_LT(shaded(0.0), 0.035 * 2160 * 2160);
}

// A canted view is a view like any other: what is seen from the gaze does not depend on it.
TEST(AcuityMap, ServesCantedViews) {
    gaze::EyeView straight = lopsided_view();
    const auto profile = value_or_throw(AcuityProfile::create({}, straight));
    const glm::dquat cant = glm::angleAxis(0.2, glm::dvec3(0, 1, 0));
    const glm::dvec3 gaze_in_head = gaze_at(10, 5);
    const AcuityMap canted(profile, GazeFrame(straight, glm::conjugate(cant) * gaze_in_head));
    for (const gaze::PixelPosition at : {gaze::PixelPosition{10.5, 20.5}, {100.5, 90.5}}) {
        const glm::dvec3 ray_in_head = cant * gaze::unproject(at, straight);
        const double e = std::acos(glm::dot(ray_in_head, gaze_in_head)) / kDegree;
        EXPECT_NEAR(canted.share(at).u, profile.u(e), 1e-9);
    }
}

}  // namespace
}  // namespace gazeloop::foveation
