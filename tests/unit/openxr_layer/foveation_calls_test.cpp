// Foveation state above a mock runtime, which knows none.
#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <glm/trigonometric.hpp>
#include <string>

#include "runtime/openxr_layer/newer_openxr.h"
#include "runtime/openxr_layer/permissions.h"
#include "runtime/openxr_layer/sightings.h"
#include "tests/support/allocation_counter.h"
#include "tests/unit/openxr_layer/mock_application.h"
#include "tests/unit/openxr_layer/mock_home.h"

namespace gazeloop::openxr_layer {
namespace {

const std::vector<const char*> kFoveationExtensions{
    XR_FB_FOVEATION_EXTENSION_NAME, XR_FB_FOVEATION_CONFIGURATION_EXTENSION_NAME,
    XR_FB_SWAPCHAIN_UPDATE_STATE_EXTENSION_NAME, newer::kFoveationEyeTrackedName};

newer::FoveationEyeTrackedState state_of(const MockApplication& application, XrResult& result) {
    newer::FoveationEyeTrackedState state{};
    state.type = newer::kFoveationEyeTrackedState;
    result = application.call<newer::GetFoveationEyeTrackedState>(
        "xrGetFoveationEyeTrackedStateMETA")(application.session, &state);
    return state;
}

bool supports(const MockApplication& application) {
    newer::SystemFoveationEyeTrackedProperties eyes{newer::kSystemFoveationEyeTrackedProperties,
                                                    nullptr, XR_FALSE};
    auto properties = openxr::typed<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
    properties.next = &eyes;
    application.call<PFN_xrGetSystemProperties>("xrGetSystemProperties")(application.instance, 1,
                                                                         &properties);
    return eyes.supportsFoveationEyeTracked == XR_TRUE;
}

TEST(FoveationCalls, TellTheCentreOfTheGaze) {
    const Home home;
    set_settings("layer.gaze=fixed:10,5");
    MockApplication application(kFoveationExtensions);
    ASSERT_EQ(application.make_session(), XR_SUCCESS);
    EXPECT_TRUE(supports(application));
    application.make_reference_space(XR_REFERENCE_SPACE_TYPE_LOCAL);
    XrResult result = XR_SUCCESS;
    for (int frame = 0; frame < 3; ++frame) {
        application.frame(application.spaces[0]);
        const newer::FoveationEyeTrackedState state = state_of(application, result);
        ASSERT_EQ(result, XR_SUCCESS);
        ASSERT_EQ(state.flags, newer::kFoveationEyeTrackedStateValid);
        for (const XrVector2f& centre : state.foveationCenter) {
            // The mock's fields of view: .8 to each side, .7 up and down.
            EXPECT_NEAR(centre.x, std::tan(glm::radians(10.0)) / std::tan(0.8), 1e-3);
            EXPECT_NEAR(centre.y,
                        std::tan(glm::radians(5.0)) / std::cos(glm::radians(10.0)) / std::tan(0.7),
                        1e-3);
        }
    }
}

TEST(FoveationCalls, AllocateNothingInSteadyState) {
    const Home home;
    set_settings("layer.gaze=fixed:10,5");
    MockApplication application(kFoveationExtensions);
    ASSERT_EQ(application.make_session(), XR_SUCCESS);
    XrResult result = XR_SUCCESS;
    for (int i = 0; i < 100; ++i) {
        state_of(application, result);
    }
    const std::size_t before = tests::allocations_of_this_thread();
    for (int i = 0; i < 500; ++i) {
        state_of(application, result);
    }
    EXPECT_EQ(tests::allocations_of_this_thread(), before);
}

/// The centre without the gaze: neither action nor space tells it.
TEST(FoveationCalls, GiveTheCentreAndNoGazeWhereThatIsPermitted) {
    const Home home;
    set_settings("layer.gaze=fixed:10,5\nlayer.unknown_applications=foveation");
    std::vector<const char*> extensions = kFoveationExtensions;
    extensions.push_back(XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME);
    MockApplication application(extensions);
    ASSERT_EQ(application.make_session(), XR_SUCCESS);
    ASSERT_EQ(application.make_set(), XR_SUCCESS);
    ASSERT_EQ(application.make_action(application.sets[0], false), XR_SUCCESS);
    ASSERT_EQ(application.suggest(application.actions), XR_SUCCESS);
    ASSERT_EQ(application.attach(), XR_SUCCESS);
    ASSERT_EQ(application.make_gaze_space(application.actions[0]), XR_SUCCESS);
    ASSERT_EQ(application.make_reference_space(XR_REFERENCE_SPACE_TYPE_VIEW), XR_SUCCESS);
    application.sync();
    application.sync();
    EXPECT_FALSE(application.active(application.actions[0]));
    XrResult result = XR_SUCCESS;
    // It is where the runtime says, which knows no gaze.
    const XrSpaceLocation location = application.locate(
        application.spaces[0], application.spaces[1], MockRuntime::now(), result);
    EXPECT_EQ(location.pose.position.y, 1.6F);
    EXPECT_EQ(location.pose.orientation.x, 0.0F);
    EXPECT_EQ(state_of(application, result).flags, newer::kFoveationEyeTrackedStateValid);
    const auto seen = sightings();
    ASSERT_EQ(seen.size(), 1U);
    EXPECT_EQ(seen[0].permission, "foveation only");
    EXPECT_EQ(seen[0].read_gaze_utc, "");
}

TEST(FoveationCalls, TellNothingToWhomItIsDenied) {
    for (const char* const settings :
         {"layer.gaze=fixed:10,5\nlayer.unknown_applications=deny",
          "layer.gaze=fixed:10,5\nlayer.unknown_applications=ask", "", "layer.gaze=telepathy"}) {
        const Home home;
        set_settings(settings);
        MockApplication application(kFoveationExtensions);
        ASSERT_EQ(application.make_session(), XR_SUCCESS);
        XrResult result = XR_ERROR_RUNTIME_FAILURE;
        const newer::FoveationEyeTrackedState state = state_of(application, result);
        EXPECT_EQ(result, XR_SUCCESS);
        EXPECT_EQ(state.flags, 0U) << settings;
        EXPECT_EQ(state.foveationCenter[0].x, 0.0F);
    }
}

TEST(FoveationCalls, KeepProfilesAsTheyWereApplied) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    MockApplication application(kFoveationExtensions);
    ASSERT_EQ(application.make_session(), XR_SUCCESS);
    const auto create =
        application.call<PFN_xrCreateFoveationProfileFB>("xrCreateFoveationProfileFB");
    const auto destroy =
        application.call<PFN_xrDestroyFoveationProfileFB>("xrDestroyFoveationProfileFB");
    const auto update = application.call<PFN_xrUpdateSwapchainFB>("xrUpdateSwapchainFB");
    const auto get = application.call<PFN_xrGetSwapchainStateFB>("xrGetSwapchainStateFB");
    auto swapchain_info = openxr::typed<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
    XrSwapchain swapchain = XR_NULL_HANDLE;
    ASSERT_EQ(application.call<PFN_xrCreateSwapchain>("xrCreateSwapchain")(
                  application.session, &swapchain_info, &swapchain),
              XR_SUCCESS);
    auto level = openxr::typed<XrFoveationLevelProfileCreateInfoFB>(
        XR_TYPE_FOVEATION_LEVEL_PROFILE_CREATE_INFO_FB);
    level.level = XR_FOVEATION_LEVEL_HIGH_FB;
    auto info =
        openxr::typed<XrFoveationProfileCreateInfoFB>(XR_TYPE_FOVEATION_PROFILE_CREATE_INFO_FB);
    info.next = &level;
    XrFoveationProfileFB profile = XR_NULL_HANDLE;
    ASSERT_EQ(create(application.session, &info, &profile), XR_SUCCESS);
    auto state = openxr::typed<XrSwapchainStateFoveationFB>(XR_TYPE_SWAPCHAIN_STATE_FOVEATION_FB);
    auto* const header = reinterpret_cast<XrSwapchainStateBaseHeaderFB*>(&state);
    ASSERT_EQ(get(swapchain, header), XR_SUCCESS);
    EXPECT_EQ(state.profile, XrFoveationProfileFB{XR_NULL_HANDLE});
    state.profile = profile;
    EXPECT_EQ(update(swapchain, header), XR_SUCCESS);
    state.profile = XR_NULL_HANDLE;
    EXPECT_EQ(get(swapchain, header), XR_SUCCESS);
    EXPECT_EQ(state.profile, profile);

    // What is not as the extensions want it.
    level.level = static_cast<XrFoveationLevelFB>(7);
    XrFoveationProfileFB none = XR_NULL_HANDLE;
    EXPECT_EQ(create(application.session, &info, &none), XR_ERROR_VALIDATION_FAILURE);
    level.level = XR_FOVEATION_LEVEL_LOW_FB;
    level.verticalOffset = std::nanf("");
    EXPECT_EQ(create(application.session, &info, &none), XR_ERROR_VALIDATION_FAILURE);
    state.flags = 1;
    EXPECT_EQ(update(swapchain, header), XR_ERROR_VALIDATION_FAILURE);
    state.flags = 0;
    EXPECT_EQ(destroy(profile), XR_SUCCESS);
    EXPECT_EQ(destroy(profile), XR_ERROR_HANDLE_INVALID);
    state.profile = profile;
    EXPECT_EQ(update(swapchain, header), XR_ERROR_HANDLE_INVALID) << "it is no more";
    state.type = XR_TYPE_UNKNOWN;
    EXPECT_EQ(update(swapchain, header), XR_ERROR_VALIDATION_FAILURE);
    EXPECT_EQ(get(swapchain, header), XR_ERROR_VALIDATION_FAILURE);
    newer::FoveationEyeTrackedState eyes{};
    EXPECT_EQ(application.call<newer::GetFoveationEyeTrackedState>(
                  "xrGetFoveationEyeTrackedStateMETA")(application.session, &eyes),
              XR_ERROR_VALIDATION_FAILURE);
}

/// Who does not ask has none of it.
TEST(FoveationCalls, AreThereForWhoAsksOnly) {
    const Home home;
    set_settings("layer.gaze=fixed:0,0");
    {
        const MockApplication application;
        EXPECT_EQ(application.call<newer::GetFoveationEyeTrackedState>(
                      "xrGetFoveationEyeTrackedStateMETA"),
                  nullptr);
        EXPECT_FALSE(supports(application));
    }
    set_settings("layer.gaze=fixed:0,0\nlayer.foveation=never");
    XrInstance instance = XR_NULL_HANDLE;
    EXPECT_EQ(MockRuntime::the().create_through_layer(kFoveationExtensions, instance),
              XR_ERROR_EXTENSION_NOT_PRESENT);
}

TEST(Permissions, KeepThatFoveationAloneIsAllowed) {
    Permissions permissions;
    permissions.set("/opt/game", Permissions::Answer::FoveationOnly);
    const auto again = Permissions::parse(permissions.text(), "list");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->of("/opt/game"), Permissions::Answer::FoveationOnly);
}

}  // namespace
}  // namespace gazeloop::openxr_layer
