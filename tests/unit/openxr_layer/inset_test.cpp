#include "runtime/openxr_layer/quad_views/inset.h"

#include <gtest/gtest.h>
#include <rapidcheck/gtest.h>

#include <cmath>
#include <glm/trigonometric.hpp>

#include "runtime/openxr_layer/quad_views/quad_sizes.h"

namespace gazeloop::openxr_layer {
namespace {

gaze::EyeView view_of(std::uint32_t width, std::uint32_t height, double half_deg) {
    const double half = glm::radians(half_deg);
    return {.pose = {}, .fov = {-half, half, half, -half}, .width_px = width, .height_px = height};
}

/// Just outside the inset, straight beside the gaze, the picture has what the eye asks for, and a
/// little farther in it has not.
TEST(InsetSize, EndsWhereThePictureAroundItIsFineEnough) {
    const gaze::EyeView view = view_of(2160, 2160, 50.0);
    const InsetPolicy policy{.periphery = 0.4, .blend = 0.0, .margin_deg = 0.0, .acuity = {}};
    const PictureSize size = inset_size(view, policy);
    const PictureSize outer = outer_size({2160, 2160}, policy);
    const double tangents = 2.0 * std::tan(glm::radians(50.0));
    const double edge_deg = glm::degrees(std::atan(0.5 * tangents * size.width_px / 2160.0));
    const double pixel_deg = glm::degrees(tangents / outer.width_px);
    EXPECT_NEAR(2.0 * pixel_deg, policy.acuity.omega_deg(edge_deg),
                2e-3 * policy.acuity.omega_deg(edge_deg));
    EXPECT_GT(2.0 * pixel_deg, policy.acuity.omega_deg(edge_deg - 1.0));
}

TEST(InsetSize, GrowsWithTheBandAndTheMargin) {
    const gaze::EyeView view = view_of(2160, 2160, 50.0);
    const auto width = [&](double blend, double margin) {
        return inset_size(view,
                          {.periphery = 0.5, .blend = blend, .margin_deg = margin, .acuity = {}})
            .width_px;
    };
    EXPECT_GT(width(0.2, 0.0), width(0.0, 0.0));
    EXPECT_GT(width(0.0, 2.0), width(0.0, 0.0));
}

TEST(InsetSize, IsThePictureWhereNothingCanBeLeftOut) {
    // Pixels are coarser than anybody looks, everywhere.
    EXPECT_EQ(inset_size(view_of(64, 32, 50.0), {}), (PictureSize{64, 32}));
    // And a pixel where all of it is fine enough.
    EXPECT_EQ(inset_size(view_of(16384, 16384, 1.0),
                         {.periphery = 1.0, .blend = 0.0, .margin_deg = 0.0, .acuity = {}}),
              (PictureSize{1, 1}));
}

RC_GTEST_PROP(InsetPlace, LiesInThePictureOnItsPixels, ()) {
    const auto width = *rc::gen::inRange(1U, 4000U);
    const auto height = *rc::gen::inRange(1U, 4000U);
    const auto half = static_cast<double>(*rc::gen::inRange(5, 85));
    gaze::EyeView view = view_of(width, height, half);
    view.fov.left_rad *= 0.7;
    const PictureSize size{*rc::gen::inRange(1U, width + 1), *rc::gen::inRange(1U, height + 1)};
    const auto anywhere = rc::gen::inRange(-20000, 20000);
    const InsetPlace place =
        place_inset(view, size, {static_cast<double>(*anywhere), static_cast<double>(*anywhere)});
    RC_ASSERT(place.x_px + size.width_px <= width);
    RC_ASSERT(place.y_px + size.height_px <= height);
    const PicturePart part = part_of(view.fov, place.fov);
    RC_ASSERT(std::abs(part.x * width - place.x_px) < 1e-6 * width);
    RC_ASSERT(std::abs(part.y * height - place.y_px) < 1e-6 * height);
    RC_ASSERT(std::abs(part.width * width - size.width_px) < 1e-6 * width);
    RC_ASSERT(std::abs(part.height * height - size.height_px) < 1e-6 * height);
}

TEST(InsetPlace, IsAroundTheFovea) {
    const gaze::EyeView view = view_of(1000, 1000, 45.0);
    const InsetPlace place = place_inset(view, {300, 200}, {400.0, 600.0});
    EXPECT_EQ(place.x_px, 250U);
    EXPECT_EQ(place.y_px, 500U);
    EXPECT_NEAR(place.fov.left_rad, std::atan(-0.5), 1e-12);
    EXPECT_NEAR(place.fov.up_rad, 0.0, 1e-12);
}

TEST(QuadSizes, SaveMostPixelsOfAHeadsetOfToday) {
    const QuadSizes sizes = quad_sizes({2160, 2160}, {});
    const auto pixels = [](const PictureSize& size) {
        return std::uint64_t{size.width_px} * size.height_px;
    };
    EXPECT_EQ(sizes.outer, (PictureSize{1080, 1080}));
    EXPECT_LT(pixels(sizes.outer) + pixels(sizes.inset), pixels(sizes.full) / 2);
}

}  // namespace
}  // namespace gazeloop::openxr_layer
