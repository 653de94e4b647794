// Four views above a mock runtime, which has two. Nothing is drawn: there is no Vulkan.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "runtime/openxr_layer/quad_views/quad_sizes.h"
#include "tests/unit/openxr_layer/mock_application.h"
#include "tests/unit/openxr_layer/mock_home.h"

namespace gazeloop::openxr_layer {
namespace {

using ::testing::ElementsAre;

const std::vector<const char*> kQuadExtensions{XR_VARJO_QUAD_VIEWS_EXTENSION_NAME,
                                               XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME};

struct FourViews {
    std::array<XrView, kQuadViewCount> views{};
    std::uint32_t count = 0;
    XrResult result = XR_SUCCESS;
};

struct QuadApplication : MockApplication {
    QuadApplication() : MockApplication(kQuadExtensions) {
        make_vulkan_session();
        make_reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL);
    }
    [[nodiscard]] FourViews located(std::uint32_t capacity = kQuadViewCount) const {
        FourViews four;
        four.result = locate_four(spaces[0], four.views, capacity, four.count);
        return four;
    }
    [[nodiscard]] XrResult end(XrSwapchain swapchain, std::uint32_t views = kQuadViewCount,
                               std::int32_t side = 100) const {
        return end_with_four(swapchain, spaces[0], views, side);
    }
};

TEST(QuadViewCalls, EnumerateFourViews) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    QuadApplication application;
    const auto enumerate =
        application.call<PFN_xrEnumerateViewConfigurations>("xrEnumerateViewConfigurations");
    std::uint32_t count = 0;
    ASSERT_EQ(enumerate(application.instance, 1, 0, &count, nullptr), XR_SUCCESS);
    ASSERT_EQ(count, 2U);
    std::vector<XrViewConfigurationType> types(2);
    EXPECT_EQ(enumerate(application.instance, 1, 1, &count, types.data()),
              XR_ERROR_SIZE_INSUFFICIENT);
    ASSERT_EQ(enumerate(application.instance, 1, 2, &count, types.data()), XR_SUCCESS);
    EXPECT_THAT(types, ElementsAre(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, kQuadViews));

    const auto enumerate_views = application.call<PFN_xrEnumerateViewConfigurationViews>(
        "xrEnumerateViewConfigurationViews");
    ASSERT_EQ(enumerate_views(application.instance, 1, kQuadViews, 0, &count, nullptr), XR_SUCCESS);
    ASSERT_EQ(count, kQuadViewCount);
    std::vector<XrViewConfigurationView> views(
        count, openxr::typed<XrViewConfigurationView>(XR_TYPE_VIEW_CONFIGURATION_VIEW));
    EXPECT_EQ(enumerate_views(application.instance, 1, kQuadViews, 3, &count, views.data()),
              XR_ERROR_SIZE_INSUFFICIENT);
    ASSERT_EQ(enumerate_views(application.instance, 1, kQuadViews, 4, &count, views.data()),
              XR_SUCCESS);
    const QuadSizes sizes = quad_sizes({1600, 1600}, {});
    EXPECT_EQ(views[1].recommendedImageRectWidth, sizes.outer.width_px);
    EXPECT_EQ(views[2].recommendedImageRectWidth, sizes.inset.width_px);
    EXPECT_EQ(views[3].recommendedImageRectHeight, sizes.inset.height_px);
    EXPECT_EQ(views[3].maxImageRectWidth, 4096U);

    auto properties =
        openxr::typed<XrViewConfigurationProperties>(XR_TYPE_VIEW_CONFIGURATION_PROPERTIES);
    ASSERT_EQ(
        application.call<PFN_xrGetViewConfigurationProperties>("xrGetViewConfigurationProperties")(
            application.instance, 1, kQuadViews, &properties),
        XR_SUCCESS);
    EXPECT_EQ(properties.viewConfigurationType, kQuadViews);
    EXPECT_EQ(properties.fovMutable, XR_TRUE);
}

TEST(QuadViewCalls, LocateInsetsWhereItIsLooked) {
    for (const auto& [settings, azimuth_deg] :
         {std::pair{"layer.gaze=fixed:12,0", 12.0},
          {"layer.gaze=fixed:12,0\nlayer.unknown_applications=foveation", 12.0},
          // Who may not follow the gaze looks ahead.
          {"layer.gaze=fixed:12,0\nlayer.unknown_applications=deny", 0.0},
          {"", 0.0}}) {
        const Home home;
        set_settings(settings);
        QuadApplication application;
        ASSERT_EQ(application.begin(kQuadViews), XR_SUCCESS);
        const FourViews four = application.located();
        ASSERT_EQ(four.result, XR_SUCCESS);
        ASSERT_EQ(four.count, kQuadViewCount);
        const double pixel = 2.0 * std::tan(0.8) / 1600.0;
        for (std::size_t eye = 0; eye < 2; ++eye) {
            const XrFovf& outer = four.views[eye].fov;
            const XrFovf& inset = four.views[eye + 2].fov;
            EXPECT_EQ(four.views[eye].pose.position.x, four.views[eye + 2].pose.position.x);
            EXPECT_GT(inset.angleLeft, outer.angleLeft);
            EXPECT_LT(inset.angleRight, outer.angleRight);
            EXPECT_LT(inset.angleUp, outer.angleUp);
            EXPECT_GT(inset.angleDown, outer.angleDown);
            EXPECT_NEAR(0.5 * (std::tan(inset.angleLeft) + std::tan(inset.angleRight)),
                        std::tan(glm::radians(azimuth_deg)), pixel)
                << settings;
        }
        EXPECT_EQ(application.located(3).result, XR_ERROR_SIZE_INSUFFICIENT);
        EXPECT_EQ(application.located(0).count, kQuadViewCount);
    }
}

TEST(QuadViewCalls, HoldImagesUntilTheirFrameHasEnded) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    QuadApplication application;
    ASSERT_EQ(application.begin(kQuadViews), XR_SUCCESS);
    ASSERT_EQ(application.make_swapchain(), XR_SUCCESS);
    const XrSwapchain swapchain = application.swapchains[0];
    EXPECT_EQ(application.end(swapchain), XR_ERROR_LAYER_INVALID) << "nothing was drawn";
    for (int frame = 0; frame < 5; ++frame) {
        ASSERT_EQ(application.draw(swapchain), XR_SUCCESS);
        EXPECT_EQ(MockRuntime::the().acquired_images(), 1U) << "it is read yet";
        // Without a device the outer views are shown alone.
        ASSERT_EQ(application.end(swapchain), XR_SUCCESS);
        EXPECT_EQ(MockRuntime::the().acquired_images(), 0U);
        EXPECT_THAT(MockRuntime::the().view_counts(), ElementsAre(2U));
    }
    // Several images in one frame, and one that is ended without.
    for (int image = 0; image < 7; ++image) {
        ASSERT_EQ(application.draw(swapchain), XR_SUCCESS);
    }
    EXPECT_EQ(application.call<PFN_xrReleaseSwapchainImage>("xrReleaseSwapchainImage")(swapchain,
                                                                                       nullptr),
              XR_ERROR_CALL_ORDER_INVALID);
    ASSERT_EQ(application.end(swapchain), XR_SUCCESS);
    ASSERT_EQ(application.end(swapchain), XR_SUCCESS);
    EXPECT_EQ(MockRuntime::the().acquired_images(), 0U);
}

TEST(QuadViewCalls, RefuseWhatTheSpecificationRefuses) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    QuadApplication application;
    ASSERT_EQ(application.begin(kQuadViews), XR_SUCCESS);
    ASSERT_EQ(application.make_swapchain(), XR_SUCCESS);
    const XrSwapchain swapchain = application.swapchains[0];
    ASSERT_EQ(application.draw(swapchain), XR_SUCCESS);
    EXPECT_EQ(application.end(swapchain, 2), XR_ERROR_VALIDATION_FAILURE);
    EXPECT_EQ(application.end(swapchain, 4, 101), XR_ERROR_SWAPCHAIN_RECT_INVALID);
    EXPECT_EQ(application.end(XR_NULL_HANDLE), XR_ERROR_HANDLE_INVALID);
    EXPECT_EQ(application.end(swapchain), XR_SUCCESS);
}

TEST(QuadViewCalls, LeaveStereoAsItIs) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    QuadApplication application;
    ASSERT_EQ(application.begin(XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO), XR_SUCCESS);
    ASSERT_EQ(application.make_swapchain(), XR_SUCCESS);
    const XrSwapchain swapchain = application.swapchains[0];
    ASSERT_EQ(application.draw(swapchain), XR_SUCCESS);
    EXPECT_EQ(MockRuntime::the().acquired_images(), 0U);
    ASSERT_EQ(application.end(swapchain, 2), XR_SUCCESS);
    EXPECT_THAT(MockRuntime::the().view_counts(), ElementsAre(2U));
}

/// Who does not ask, or does not draw with Vulkan, has the runtime's functions.
TEST(QuadViewCalls, AreThereForWhoAsksOnly) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    const auto count_of = [](const MockApplication& application) {
        std::uint32_t count = 0;
        application.call<PFN_xrEnumerateViewConfigurations>("xrEnumerateViewConfigurations")(
            application.instance, 1, 0, &count, nullptr);
        return count;
    };
    {
        const MockApplication application(
            {XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME, XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME});
        EXPECT_EQ(count_of(application), 1U);
    }
    {
        const MockApplication application({XR_VARJO_QUAD_VIEWS_EXTENSION_NAME});
        EXPECT_EQ(count_of(application), 1U);
    }
    MockApplication application(kQuadExtensions);
    EXPECT_EQ(count_of(application), 2U);
    ASSERT_EQ(application.make_session(), XR_SUCCESS);
    auto info = openxr::typed<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
    info.primaryViewConfigurationType = kQuadViews;
    EXPECT_EQ(application.call<PFN_xrBeginSession>("xrBeginSession")(application.session, &info),
              XR_ERROR_VIEW_CONFIGURATION_TYPE_UNSUPPORTED)
        << "its session is none of Vulkan";
}

}  // namespace
}  // namespace gazeloop::openxr_layer
