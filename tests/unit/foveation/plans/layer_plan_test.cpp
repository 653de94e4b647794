#include "runtime/foveation/plans/layer_plan.h"

#include <gtest/gtest.h>

#include <cmath>

#include "tests/unit/foveation/picture/example_views.h"

namespace gazeloop::foveation {
namespace {

const LayerOptions kThree{.layers = 3, .weights = {}};

LayerPlan plan(const gaze::EyeView& view, const glm::dvec3& gaze,
               const LayerOptions& options = kThree) {
    return plan_layers(GazeField::create(view, gaze).value(), {}, options).value();
}

TEST(LayerDisplay, TakesTheAxisWithTheCoarserPixels) {
    const LayerDisplay fove = layer_display(fove_view());
    EXPECT_EQ(fove.width_px, 1280.0);
    EXPECT_DOUBLE_EQ(fove.aspect, 1440.0 / 1280.0);
    const LayerDisplay tall = layer_display(symmetrical_view(1440, 1280, 100, 100));
    EXPECT_EQ(tall.width_px, 1280.0);
    EXPECT_NEAR(tall.half_width_tangent, std::tan(glm::radians(50.0)), 1e-12);
}

// At the centre, the plan is the optimiser's: its squares fit into the picture.
TEST(LayerPlan, AtTheCentreTakesTheOptimisersPixels) {
    const LayerPlan planned = plan(square_2160_view(), kAhead);
    const EccentricityLayers best =
        optimise_layers(layer_display(square_2160_view()), {}, kThree).value();
    ASSERT_EQ(planned.layers.size(), 3U);
    for (std::size_t i = 0; i < 3; ++i) {
        EXPECT_EQ(planned.layers[i].factor, best.layers[i].factor);
        // Whole pixels around the gaze, then whole samples.
        EXPECT_GE(planned.layers[i].width + 1e-9, best.layers[i].width_px);
        EXPECT_LE(planned.layers[i].width, best.layers[i].width_px + 3.0);
        EXPECT_EQ(planned.layers[i].width, planned.layers[i].height);
    }
    EXPECT_NEAR(static_cast<double>(planned.samples()) / best.work, 1.0, 0.01);
    EXPECT_NEAR(2160.0 * 2160.0 / static_cast<double>(planned.samples()), 9.1, 0.1);
    EXPECT_DOUBLE_EQ(planned.weighted_samples(), static_cast<double>(planned.samples()));
}

TEST(LayerPlan, WeightsCount) {
    const LayerOptions half{.layers = 3, .weights = {1.0, 0.5, 0.5}};
    const LayerPlan planned = plan(square_2160_view(), kAhead, half);
    double expected = 0.0;
    for (std::size_t i = 0; i < 3; ++i) {
        expected += (i == 0 ? 1.0 : 0.5) * planned.layers[i].width * planned.layers[i].height;
    }
    EXPECT_DOUBLE_EQ(planned.weighted_samples(), expected);
    EXPECT_LT(planned.weighted_samples(), static_cast<double>(planned.samples()));
}

TEST(LayerPlan, IsCutByThePicture) {
    const LayerPlan centre = plan(fove_view(), kAhead);
    const LayerPlan corner = plan(fove_view(), towards(49.0, -49.0));
    const LayerPlan away = plan(fove_view(), towards(170.0, 0.0));
    EXPECT_LT(corner.layers[0].covers.area(), centre.layers[0].covers.area());
    EXPECT_EQ(away.layers[0].covers.area(), 0U);
    EXPECT_EQ(away.layers[0].width, 0U);
    for (const LayerPlan* const planned : {&centre, &corner, &away}) {
        EXPECT_EQ(planned->layers.back().covers.area(), 1280U * 1440U);
        for (const PlannedLayer& layer : planned->layers) {
            EXPECT_LE(layer.covers.x1, 1280U);
            EXPECT_LE(layer.covers.y1, 1440U);
        }
    }
}

TEST(LayerPlan, ExtremeSizes) {
    for (const gaze::EyeView& view :
         {symmetrical_view(2, 2, 100, 100), symmetrical_view(16384, 2, 100, 1),
          symmetrical_view(16384, 16384, 170, 170), symmetrical_view(2000, 2000, 0.1, 0.1)}) {
        const LayerPlan planned = plan(view, kAhead);
        ASSERT_FALSE(planned.layers.empty());
        EXPECT_GT(planned.samples(), 0U);
        EXPECT_LE(planned.samples(), std::uint64_t{view.width_px} * view.height_px);
    }
    // One pixel has no width to divide: refused by name.
    const auto one = plan_layers(
        GazeField::create(symmetrical_view(1, 1, 100, 100), kAhead).value(), {}, kThree);
    ASSERT_FALSE(one.has_value());
    EXPECT_NE(one.error().message.find("width_px = 1"), std::string::npos);
}

}  // namespace
}  // namespace gazeloop::foveation
