// The acuity map's disc where the gaze is uncertain.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "runtime/foveation/plans/acuity_plan.h"

namespace gazeloop::foveation {
namespace {

/// 2160 x 2160 px over 100 degrees: e_c is some 5 degrees.
gaze::EyeView view() {
    const double half = glm::radians(50.0);
    return {.pose = {},
            .fov = {.left_rad = -half, .right_rad = half, .up_rad = half, .down_rad = -half},
            .width_px = 2160,
            .height_px = 2160};
}

gaze::FoveaPoint fovea(std::optional<double> uncertainty_deg) {
    gaze::FoveaPoint point;
    point.direction = {0.2, -0.1, -0.97};
    if (uncertainty_deg) {
        point.uncertainty_rad = glm::radians(*uncertainty_deg);
        point.widens = true;
    }
    return point;
}

LogPolarPlan planned(const AcuityProfile& profile, double widening_deg,
                     const AcuityParameters& parameters = {}) {
    LogPolarPlan plan;
    plan_acuity(parameters, profile, view(), fovea({}).direction, plan, nullptr, widening_deg);
    return plan;
}

TEST(WidenedDisc, ReachesEveryPlaceWhereTheEyeMayLook) {
    const auto profile = AcuityProfile::create({}, view());
    ASSERT_TRUE(profile.has_value());
    const double limit_deg = profile->display_limit_deg();
    const LogPolarPlan plain = planned(*profile, 0.0);
    const double plain_deg = 2.0 * glm::degrees(std::asin(plain.in_gaze_frame->disc_half_sine));
    ASSERT_GE(plain_deg, limit_deg);
    for (const double widening_deg : {3.0, 8.0, 20.0}) {
        const LogPolarPlan wide = planned(*profile, widening_deg);
        const double wide_deg = 2.0 * glm::degrees(std::asin(wide.in_gaze_frame->disc_half_sine));
        EXPECT_NEAR(wide_deg, std::max(plain_deg, limit_deg + widening_deg), 1e-9);
        EXPECT_GE(wide.disc.counts.shaded, plain.disc.counts.shaded);
        EXPECT_LE(wide.texels.counts.shaded, plain.texels.counts.shaded);
        EXPECT_EQ(wide.lp, plain.lp) << "the same tables and buffer";
    }
    EXPECT_GT(planned(*profile, 20.0).disc.counts.shaded, 4 * plain.disc.counts.shaded);
    // Beyond what a disc can be it stays one of 90 degrees.
    const LogPolarPlan widest = planned(*profile, 180.0);
    EXPECT_NEAR(widest.in_gaze_frame->disc_half_sine, std::sqrt(0.5), 1e-12);
    AcuityParameters no_disc;
    no_disc.disc = false;
    EXPECT_EQ(planned(*profile, 20.0, no_disc).in_gaze_frame->disc_half_sine, 0.0);
}

TEST(WidenedDisc, IsTheFoveaPointsAndOtherwiseAsBefore) {
    AcuityPlan method{AcuityParameters{}};
    ASSERT_TRUE(method.prepare({view(), view()}).has_value());
    const auto shaded = [&](const gaze::FoveaPoint& point) {
        EyePlan plan;
        method.plan(gaze::Eye::Left, view(), point, nullptr, {}, plan);
        return plan.grids[1].counts.shaded;
    };
    const std::uint64_t plain = shaded(fovea(std::nullopt));
    EXPECT_EQ(plain, shaded(fovea(0.0)));
    EXPECT_GT(shaded(fovea(12.0)), 2 * plain);
    // What a prediction states of itself widens nothing.
    gaze::FoveaPoint predicted = fovea(12.0);
    predicted.widens = false;
    EXPECT_EQ(plain, shaded(predicted));
}

}  // namespace
}  // namespace gazeloop::foveation
