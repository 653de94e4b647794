#pragma once

#include <array>
#include <stdexcept>
#include <vector>

#include "runtime/openxr_layer/gazeloop_gaze_sample.h"
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

    XrInstance instance = XR_NULL_HANDLE;
    XrSession session = XR_NULL_HANDLE;
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
