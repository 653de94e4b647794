// What 3D-KFR plans: which view is in which region, and what each region's LP-buffer takes.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <set>

#include "runtime/foveation/plans/kfr3d_plan.h"
#include "tests/unit/foveation/picture/masks.h"

namespace gazeloop::foveation {
namespace {

constexpr std::uint32_t kWidth = 240;
constexpr std::uint32_t kHeight = 181;

gaze::EyeView view() {
    gaze::EyeView made = tests::square_view(kWidth, kHeight);
    made.pose.position_m = {0.004, -0.002, 0.0};
    return made;
}

gaze::FoveaPoint at(double x_px, double y_px) {
    gaze::FoveaPoint fovea;
    fovea.position = {x_px, y_px};
    fovea.direction = gaze::unproject(fovea.position, view());
    return fovea;
}

const std::array kGazes{at(120.0, 90.5), at(0.0, 181.0), at(230.0, 10.0), at(-300.0, 90.0),
                        at(4e3, -5e3)};

light_field::LightField field(double aperture_m) {
    return {.cameras = {.columns = 9, .rows = 9}, .lens = {.aperture_m = aperture_m}};
}

EyePlan plan_of(Kfr3dPlan& method, const gaze::FoveaPoint& fovea,
                const HiddenArea* hidden = nullptr) {
    value_or_throw(method.prepare({view(), view()}));
    EyePlan plan;
    method.plan(gaze::Eye::Left, view(), fovea, hidden, {}, plan);
    return plan;
}

float number(const EyePlan& plan, std::size_t listed, std::size_t of) {
    return std::bit_cast<float>(
        plan.table.at(Kfr3dPlan::kViewsBegin + Kfr3dPlan::kViewWords * listed + of));
}

TEST(Kfr3dPlan, PutsViewsIntoRegionsByDistance) {
    const Kfr3dParameters three{.kfr = {}, .regions = 3, .inner = 0.4};
    // r_0 is .4 of the reach, r_1 .7, and the last region has everything beyond.
    EXPECT_EQ(region_of(three, 0.0, 1.0), 0U);
    EXPECT_EQ(region_of(three, 0.39, 1.0), 0U);
    EXPECT_EQ(region_of(three, 0.41, 1.0), 1U);
    EXPECT_EQ(region_of(three, 0.69, 1.0), 1U);
    EXPECT_EQ(region_of(three, 0.71, 1.0), 2U);
    EXPECT_EQ(region_of(three, 2.0, 1.0), 2U);
    EXPECT_EQ(region_of(three, 0.0, 0.0), 0U) << "one view";
    EXPECT_EQ(region_of({.kfr = {}, .regions = 1}, 5.0, 1.0), 0U);
    EXPECT_EQ(region_of({.kfr = {}, .regions = 4, .inner = 1.0}, 1.5, 1.0), 3U)
        << "no room between";
    EXPECT_EQ(region_of({.kfr = {}, .regions = 2, .inner = 0.0}, 0.1, 1.0), 1U);
}

TEST(Kfr3dPlan, ListsEveryViewOfTheLensOnceRegionByRegion) {
    for (const double aperture_m : {0.0, 0.008, 1.0}) {
        for (std::uint32_t regions = 1; regions <= Kfr3dParameters::kMostRegions; ++regions) {
            const Kfr3dParameters parameters{.kfr = {}, .regions = regions};
            Kfr3dPlan method(parameters, field(aperture_m));
            const light_field::ViewsInLens lens(field(aperture_m), view().pose.position_m);
            for (const gaze::FoveaPoint& fovea : kGazes) {
                const EyePlan plan = plan_of(method, fovea);
                ASSERT_LE(plan.table.size(), method.table_words());
                std::set<float> layers;
                double weights = 0.0;
                std::array<double, Kfr3dParameters::kMostRegions> farthest{};
                const glm::dvec2 aside{fovea.position.x_px / (0.5 * kWidth) - 1.0,
                                       1.0 - fovea.position.y_px / (0.5 * kHeight)};
                const glm::dvec2 gaze_m =
                    lens.middle_m() + lens.reach_m() * (aside / std::max(1.0, glm::length(aside)));
                for (std::uint32_t region = 0; region < Kfr3dParameters::kMostRegions; ++region) {
                    EXPECT_TRUE(region < regions || Kfr3dPlan::views_in(plan.table, region) == 0);
                    for (std::uint32_t i = plan.table[region]; i < plan.table[region + 1]; ++i) {
                        const glm::dvec2 camera_m{number(plan, i, 0), number(plan, i, 1)};
                        const double distance_m = glm::distance(camera_m, gaze_m);
                        farthest.at(region) = std::max(farthest.at(region), distance_m);
                        if (region > 0) {
                            EXPECT_GE(distance_m, farthest.at(region - 1) - 1e-6);
                        }
                        layers.insert(number(plan, i, 2));
                        weights += number(plan, i, 3);
                    }
                }
                EXPECT_EQ(layers.size(), plan.table[Kfr3dParameters::kMostRegions]);
                EXPECT_NEAR(weights, 1.0, 1e-5);
            }
        }
    }
}

// Of one view it is KFR, whatever the regions are.
TEST(Kfr3dPlan, OfOneViewIsKfr) {
    const HiddenArea corners(tests::cut_corners(0.3), view());
    Kfr3dPlan method({.kfr = {.sigma = 2.0}, .regions = 4}, {});
    KfrPlan kfr({.sigma = 2.0});
    value_or_throw(kfr.prepare({view(), view()}));
    for (const gaze::FoveaPoint& fovea : kGazes) {
        for (const HiddenArea* const hidden : {static_cast<const HiddenArea*>(nullptr), &corners}) {
            const EyePlan plan = plan_of(method, fovea, hidden);
            EyePlan expected;
            kfr.plan(gaze::Eye::Left, view(), fovea, hidden, {}, expected);
            EXPECT_EQ(plan.grids.at(0).counts, expected.grids.at(0).counts);
            EXPECT_EQ(plan.grids.at(4).counts, expected.grids.at(1).counts);
            for (const std::size_t outer : {1U, 2U, 3U}) {
                EXPECT_TRUE(plan.grids.at(outer).tiles.empty());
                EXPECT_EQ(plan.grids.at(outer).counts, frame::GridCounts{});
            }
        }
    }
}

// Each region's texels are those of KFR by its own sigma, but for what the common disc covers: Eq.
// 14, measured. Bands, and a texel more on every side, make the outer regions dearer than that.
TEST(Kfr3dPlan, TakesTexelsByTheSquareOfEachSigma) {
    Kfr3dPlan method({.kfr = {.sigma = 1.5, .disc = false}, .regions = 3, .growth = 2.0},
                     field(1.0));
    const EyePlan plan = plan_of(method, at(120.0, 90.5));
    const auto texels = [&](std::size_t region) {
        return static_cast<double>(plan.grids.at(region).counts.shaded);
    };
    EXPECT_NEAR(texels(0) / texels(1), 4.0, 0.5);
    EXPECT_NEAR(texels(1) / texels(2), 4.0, 0.6);
    EXPECT_EQ(method.lp(gaze::Eye::Left, 0), (LpSize{160, 121}));
    EXPECT_EQ(method.lp(gaze::Eye::Left, 2), (LpSize{40, 30}));
}

TEST(Kfr3dPlan, KeepsOuterBuffersLargeEnough) {
    const auto sizes =
        region_sizes({.kfr = {.sigma = 30.0}, .regions = 4, .growth = 4.0}, {240, 181});
    ASSERT_TRUE(sizes.has_value());
    for (const LpSize& lp : *sizes) {
        EXPECT_TRUE(lp.in_range());
    }
    EXPECT_FALSE(region_sizes({.kfr = {.sigma = 0.1}}, {240, 181}).has_value());
}

}  // namespace
}  // namespace gazeloop::foveation
