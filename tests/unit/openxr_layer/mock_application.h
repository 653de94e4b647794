#pragma once

#include <array>
#include <stdexcept>
#include <vector>

#include "runtime/openxr_layer/gazeloop_gaze_sample.h"
#include "runtime/openxr_layer/newer_openxr.h"
#include "tests/unit/openxr_layer/mock_runtime.h"

namespace gazeloop::openxr_layer {

/// What an application holds, and the functions it calls.
class MockApplication {
  public:
    explicit MockApplication(const std::vector<const char*>& extensions = {
                                 XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME,
                                 XR_GAZELOOP_GAZE_SAMPLE_EXTENSION_NAME}) {
        if (XR_FAILED(MockRuntime::the().create_through_layer(extensions, instance))) {
            throw std::runtime_error("no instance");
        }
    }
    MockApplication(const MockApplication&) = delete;
    MockApplication& operator=(const MockApplication&) = delete;
    ~MockApplication() { call<PFN_xrDestroyInstance>("xrDestroyInstance")(instance); }

    template <typename Function>
    [[nodiscard]] Function call(const char* name) const {
        return MockRuntime::through_layer<Function>(instance, name);
    }
    [[nodiscard]] XrPath path(const char* text) const {
        XrPath path = XR_NULL_PATH;
        call<PFN_xrStringToPath>("xrStringToPath")(instance, text, &path);
        return path;
    }

    XrResult make_session() {
        const auto info = openxr::typed<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
        return call<PFN_xrCreateSession>("xrCreateSession")(instance, &info, &session);
    }
    XrResult make_set(std::uint32_t priority = 0) {
        auto info = openxr::typed<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
        info.priority = priority;
        XrActionSet set = XR_NULL_HANDLE;
        const XrResult result =
            call<PFN_xrCreateActionSet>("xrCreateActionSet")(instance, &info, &set);
        if (XR_SUCCEEDED(result)) {
            sets.push_back(set);
        }
        return result;
    }
    XrResult make_action(XrActionSet set, bool for_eyes) {
        auto info = openxr::typed<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
        info.actionType = XR_ACTION_TYPE_POSE_INPUT;
        const XrPath eyes = path("/user/eyes_ext");
        info.countSubactionPaths = for_eyes ? 1 : 0;
        info.subactionPaths = for_eyes ? &eyes : nullptr;
        XrAction action = XR_NULL_HANDLE;
        const XrResult result = call<PFN_xrCreateAction>("xrCreateAction")(set, &info, &action);
        if (XR_SUCCEEDED(result)) {
            actions.push_back(action);
        }
        return result;
    }
    XrResult suggest(const std::vector<XrAction>& bound) {
        std::vector<XrActionSuggestedBinding> bindings;
        bindings.reserve(bound.size());
        for (const XrAction action : bound) {
            bindings.push_back({action, path("/user/eyes_ext/input/gaze_ext/pose")});
        }
        auto info = openxr::typed<XrInteractionProfileSuggestedBinding>(
            XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
        info.interactionProfile = path("/interaction_profiles/ext/eye_gaze_interaction");
        info.countSuggestedBindings = static_cast<std::uint32_t>(bindings.size());
        info.suggestedBindings = bindings.data();
        return call<PFN_xrSuggestInteractionProfileBindings>("xrSuggestInteractionProfileBindings")(
            instance, &info);
    }
    XrResult attach() {
        auto info =
            openxr::typed<XrSessionActionSetsAttachInfo>(XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
        info.countActionSets = static_cast<std::uint32_t>(sets.size());
        info.actionSets = sets.data();
        return call<PFN_xrAttachSessionActionSets>("xrAttachSessionActionSets")(session, &info);
    }
    XrResult sync(XrPath user = XR_NULL_PATH) {
        synced.clear();
        for (const XrActionSet set : sets) {
            synced.push_back({set, user});
        }
        auto info = openxr::typed<XrActionsSyncInfo>(XR_TYPE_ACTIONS_SYNC_INFO);
        info.countActiveActionSets = static_cast<std::uint32_t>(synced.size());
        info.activeActionSets = synced.data();
        return call<PFN_xrSyncActions>("xrSyncActions")(session, &info);
    }
    [[nodiscard]] bool active(XrAction action, XrPath user = XR_NULL_PATH) const {
        auto info = openxr::typed<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
        info.action = action;
        info.subactionPath = user;
        auto state = openxr::typed<XrActionStatePose>(XR_TYPE_ACTION_STATE_POSE);
        return XR_SUCCEEDED(call<PFN_xrGetActionStatePose>("xrGetActionStatePose")(session, &info,
                                                                                   &state)) &&
               state.isActive == XR_TRUE;
    }
    XrResult make_gaze_space(XrAction action, XrPath user = XR_NULL_PATH) {
        auto info = openxr::typed<XrActionSpaceCreateInfo>(XR_TYPE_ACTION_SPACE_CREATE_INFO);
        info.action = action;
        info.subactionPath = user;
        info.poseInActionSpace = openxr::to_xr({});
        return keep_space([&](XrSpace* space) {
            return call<PFN_xrCreateActionSpace>("xrCreateActionSpace")(session, &info, space);
        });
    }
    XrResult make_reference_space(XrReferenceSpaceType type) {
        auto info = openxr::typed<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
        info.referenceSpaceType = type;
        info.poseInReferenceSpace = openxr::to_xr({});
        return keep_space([&](XrSpace* space) {
            return call<PFN_xrCreateReferenceSpace>("xrCreateReferenceSpace")(session, &info,
                                                                              space);
        });
    }
    XrSpaceLocation locate(XrSpace space, XrSpace base, XrTime time, XrResult& result) const {
        auto sample = openxr::typed<XrGazeSampleGAZELOOP>(XR_TYPE_GAZE_SAMPLE_GAZELOOP);
        auto velocity = openxr::typed<XrSpaceVelocity>(XR_TYPE_SPACE_VELOCITY);
        velocity.next = &sample;
        auto location = openxr::typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
        location.next = &velocity;
        result = call<PFN_xrLocateSpace>("xrLocateSpace")(space, base, time, &location);
        location.next = nullptr;
        return location;
    }
    /// Waited for, begun, seen from, ended.
    void frame(XrSpace views_in) {
        auto state = openxr::typed<XrFrameState>(XR_TYPE_FRAME_STATE);
        call<PFN_xrWaitFrame>("xrWaitFrame")(session, nullptr, &state);
        call<PFN_xrBeginFrame>("xrBeginFrame")(session, nullptr);
        auto info = openxr::typed<XrViewLocateInfo>(XR_TYPE_VIEW_LOCATE_INFO);
        info.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
        info.displayTime = state.predictedDisplayTime;
        info.space = views_in;
        auto view_state = openxr::typed<XrViewState>(XR_TYPE_VIEW_STATE);
        std::array<XrView, 2> views{openxr::typed<XrView>(XR_TYPE_VIEW),
                                    openxr::typed<XrView>(XR_TYPE_VIEW)};
        std::uint32_t count = 0;
        call<PFN_xrLocateViews>("xrLocateViews")(session, &info, &view_state, 2, &count,
                                                 views.data());
        auto end = openxr::typed<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
        end.displayTime = state.predictedDisplayTime;
        call<PFN_xrEndFrame>("xrEndFrame")(session, &end);
    }

    /// One that shows a panel and asks for no views; `read(display)` is done before its end.
    template <typename Read>
    void frame_of_panels(Read&& read) {
        auto state = openxr::typed<XrFrameState>(XR_TYPE_FRAME_STATE);
        call<PFN_xrWaitFrame>("xrWaitFrame")(session, nullptr, &state);
        call<PFN_xrBeginFrame>("xrBeginFrame")(session, nullptr);
        read(state.predictedDisplayTime);
        const auto panel = openxr::typed<XrCompositionLayerQuad>(XR_TYPE_COMPOSITION_LAYER_QUAD);
        const auto* const layer = reinterpret_cast<const XrCompositionLayerBaseHeader*>(&panel);
        auto end = openxr::typed<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
        end.displayTime = state.predictedDisplayTime;
        end.layerCount = 1;
        end.layers = &layer;
        call<PFN_xrEndFrame>("xrEndFrame")(session, &end);
    }

    /// All that it holds; its actions end.
    void forget() {
        for (const XrAction action : actions) {
            call<PFN_xrDestroyAction>("xrDestroyAction")(action);
        }
        for (const XrActionSet set : sets) {
            call<PFN_xrDestroyActionSet>("xrDestroyActionSet")(set);
        }
        actions.clear();
        sets.clear();
        spaces.clear();
        swapchains.clear();
        synced.clear();
    }

    // Four views. What is drawn cannot be composited: the session's device is none.

    XrResult make_vulkan_session() {
        auto binding =
            openxr::typed<XrGraphicsBindingVulkanKHR>(XR_TYPE_GRAPHICS_BINDING_VULKAN_KHR);
        auto info = openxr::typed<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
        info.next = &binding;
        return call<PFN_xrCreateSession>("xrCreateSession")(instance, &info, &session);
    }
    XrResult begin(XrViewConfigurationType type) const {
        auto info = openxr::typed<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
        info.primaryViewConfigurationType = type;
        return call<PFN_xrBeginSession>("xrBeginSession")(session, &info);
    }
    XrResult make_swapchain() {
        auto info = openxr::typed<XrSwapchainCreateInfo>(XR_TYPE_SWAPCHAIN_CREATE_INFO);
        info.usageFlags = XR_SWAPCHAIN_USAGE_COLOR_ATTACHMENT_BIT;
        info.width = info.height = 100;
        info.sampleCount = info.faceCount = info.mipCount = 1;
        info.arraySize = 4;
        XrSwapchain swapchain = XR_NULL_HANDLE;
        const XrResult result =
            call<PFN_xrCreateSwapchain>("xrCreateSwapchain")(session, &info, &swapchain);
        if (XR_SUCCEEDED(result)) {
            swapchains.push_back(swapchain);
        }
        return result;
    }
    /// Into its next image, which is then released, or kept.
    XrResult draw(XrSwapchain swapchain, bool released = true) const {
        std::uint32_t index = 0;
        for (const XrResult result :
             {call<PFN_xrAcquireSwapchainImage>("xrAcquireSwapchainImage")(swapchain, nullptr,
                                                                           &index),
              call<PFN_xrWaitSwapchainImage>("xrWaitSwapchainImage")(swapchain, nullptr)}) {
            if (XR_FAILED(result)) {
                return result;
            }
        }
        return released ? call<PFN_xrReleaseSwapchainImage>("xrReleaseSwapchainImage")(swapchain,
                                                                                       nullptr)
                        : XR_SUCCESS;
    }
    [[nodiscard]] XrResult locate_four(XrSpace space, std::array<XrView, 4>& views,
                                       std::uint32_t capacity, std::uint32_t& count) const {
        views.fill(openxr::typed<XrView>(XR_TYPE_VIEW));
        auto info = openxr::typed<XrViewLocateInfo>(XR_TYPE_VIEW_LOCATE_INFO);
        info.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_QUAD_VARJO;
        info.displayTime = MockRuntime::now();
        info.space = space;
        auto state = openxr::typed<XrViewState>(XR_TYPE_VIEW_STATE);
        return call<PFN_xrLocateViews>("xrLocateViews")(session, &info, &state, capacity, &count,
                                                        views.data());
    }
    /// A frame of one projection layer whose views are squares of the layers of one swapchain.
    XrResult end_with_four(XrSwapchain swapchain, XrSpace space, std::uint32_t view_count = 4,
                           std::int32_t side = 100) const {
        std::array<XrView, 4> seen{};
        std::uint32_t count = 0;
        static_cast<void>(locate_four(space, seen, 4, count));
        std::array<XrCompositionLayerProjectionView, 4> pictures{};
        for (std::uint32_t i = 0; i < pictures.size(); ++i) {
            pictures[i] = {XR_TYPE_COMPOSITION_LAYER_PROJECTION_VIEW,
                           nullptr,
                           seen[i].pose,
                           seen[i].fov,
                           {swapchain, {{0, 0}, {side, side}}, i}};
        }
        auto projection =
            openxr::typed<XrCompositionLayerProjection>(XR_TYPE_COMPOSITION_LAYER_PROJECTION);
        projection.space = space;
        projection.viewCount = view_count;
        projection.views = pictures.data();
        const auto* const layer =
            reinterpret_cast<const XrCompositionLayerBaseHeader*>(&projection);
        auto info = openxr::typed<XrFrameEndInfo>(XR_TYPE_FRAME_END_INFO);
        info.displayTime = MockRuntime::now();
        info.layerCount = 1;
        info.layers = &layer;
        return call<PFN_xrEndFrame>("xrEndFrame")(session, &info);
    }
    /// As an application that foveates itself does in each frame; the state's flags.
    std::uint64_t foveate(XrSwapchain swapchain) const {
        const auto info =
            openxr::typed<XrFoveationProfileCreateInfoFB>(XR_TYPE_FOVEATION_PROFILE_CREATE_INFO_FB);
        XrFoveationProfileFB profile = XR_NULL_HANDLE;
        call<PFN_xrCreateFoveationProfileFB>("xrCreateFoveationProfileFB")(session, &info,
                                                                           &profile);
        auto state =
            openxr::typed<XrSwapchainStateFoveationFB>(XR_TYPE_SWAPCHAIN_STATE_FOVEATION_FB);
        state.profile = profile;
        call<PFN_xrUpdateSwapchainFB>("xrUpdateSwapchainFB")(
            swapchain, reinterpret_cast<const XrSwapchainStateBaseHeaderFB*>(&state));
        call<PFN_xrDestroyFoveationProfileFB>("xrDestroyFoveationProfileFB")(profile);
        newer::FoveationEyeTrackedState eyes{};
        eyes.type = newer::kFoveationEyeTrackedState;
        call<newer::GetFoveationEyeTrackedState>("xrGetFoveationEyeTrackedStateMETA")(session,
                                                                                      &eyes);
        return eyes.flags;
    }

    XrInstance instance = XR_NULL_HANDLE;
    XrSession session = XR_NULL_HANDLE;
    std::vector<XrSwapchain> swapchains;
    std::vector<XrActionSet> sets;
    std::vector<XrAction> actions;
    std::vector<XrSpace> spaces;
    std::vector<XrActiveActionSet> synced;

  private:
    template <typename Make>
    XrResult keep_space(const Make& make_it) {
        XrSpace space = XR_NULL_HANDLE;
        const XrResult result = make_it(&space);
        if (XR_SUCCEEDED(result)) {
            spaces.push_back(space);
        }
        return result;
    }
};

}  // namespace gazeloop::openxr_layer
