#pragma once

#include <array>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "runtime/openxr_layer/newer_openxr.h"
#include "runtime/openxr_layer/quad_views/quad_sizes.h"
#include "tests/unit/openxr_layer/mock_application.h"

namespace gazeloop::openxr_layer {

/// What any_call needs an application to have asked for.
inline std::vector<const char*> every_extension() {
    return {XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME,
            XR_GAZELOOP_GAZE_SAMPLE_EXTENSION_NAME,
            XR_FB_FOVEATION_EXTENSION_NAME,
            XR_FB_SWAPCHAIN_UPDATE_STATE_EXTENSION_NAME,
            newer::kFoveationEyeTrackedName,
            XR_VARJO_QUAD_VIEWS_EXTENSION_NAME,
            XR_KHR_VULKAN_ENABLE2_EXTENSION_NAME};
}

/// One call that an application may make at any time, with what it holds, or held. `pick(n)` is any
/// number below n. Throws where a space is located at what is no pose.
template <typename Pick>
void any_call(MockApplication& application, Pick&& pick) {
    const auto any = [&](const auto& list) {
        using Handle = std::decay_t<decltype(list[0])>;
        return list.empty() || pick(30) == 0 ? Handle{} : list[pick(list.size())];
    };
    const auto one_of = [&](const auto& values) { return values[pick(values.size())]; };
    const XrPath eyes = application.path("/user/eyes_ext");
    const XrPath user = one_of(std::array{XrPath{XR_NULL_PATH}, eyes});
    XrResult result = XR_SUCCESS;
    switch (pick(24)) {
        case 0:
            application.make_set(static_cast<std::uint32_t>(pick(3)));
            break;
        case 1:
            application.make_action(any(application.sets), pick(2) == 1);
            break;
        case 2:
            application.suggest(application.actions);
            break;
        case 3:
            application.attach();
            break;
        case 4:
            application.make_gaze_space(any(application.actions), user);
            break;
        case 5:
            application.make_reference_space(
                one_of(std::array{XR_REFERENCE_SPACE_TYPE_VIEW, XR_REFERENCE_SPACE_TYPE_LOCAL}));
            break;
        case 6:
            application.call<PFN_xrDestroySpace>("xrDestroySpace")(any(application.spaces));
            break;
        case 7:
            application.call<PFN_xrDestroyAction>("xrDestroyAction")(any(application.actions));
            break;
        case 8:
            application.call<PFN_xrDestroyActionSet>("xrDestroyActionSet")(any(application.sets));
            break;
        case 9:
            application.frame(any(application.spaces));
            break;
        case 10:
            MockRuntime::the().set_focused(pick(2) == 1);
            break;
        case 11:
            MockRuntime::the().fail_next(
                one_of(std::array<std::string, 6>{"xrLocateSpace", "xrSyncActions", "xrWaitFrame",
                                                  "xrCreateSession", "xrLocateViews",
                                                  "xrCreateSwapchain"}),
                one_of(std::array{XR_ERROR_SESSION_LOST, XR_ERROR_RUNTIME_FAILURE}));
            break;
        case 12:
            application.call<PFN_xrDestroySession>("xrDestroySession")(application.session);
            application.make_vulkan_session();
            break;
        case 13:
        case 14:
            application.sync(user);
            break;
        case 15:
            application.make_swapchain();
            break;
        case 16:
            application.call<PFN_xrDestroySwapchain>("xrDestroySwapchain")(
                any(application.swapchains));
            break;
        case 17:
            application.draw(any(application.swapchains), pick(8) != 0);
            break;
        case 18:
            application.begin(
                one_of(std::array{XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO, kQuadViews}));
            break;
        case 19:
            application.end_with_four(any(application.swapchains), any(application.spaces));
            break;
        case 20:
            application.foveate(any(application.swapchains));
            break;
        default: {
            const XrTime time =
                one_of(std::array<XrTime, 6>{0, -1, 1, std::numeric_limits<XrTime>::max(),
                                             MockRuntime::now(), MockRuntime::now() - 50'000'000});
            const XrSpaceLocation location =
                application.locate(any(application.spaces), any(application.spaces), time, result);
            if (XR_SUCCEEDED(result) && location.locationFlags != 0 &&
                !openxr::from_xr(location.pose)) {
                throw std::runtime_error("a space is located at what is no pose");
            }
        }
    }
}

}  // namespace gazeloop::openxr_layer
