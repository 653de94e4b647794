#include "drivers/openxr/eye_gaze_action.h"

#include <cstring>

#include "runtime/openxr/instance.h"
#include "runtime/time/clock.h"

namespace gazeloop::drivers {

using openxr::path_of;
using openxr::typed;
using openxr::xr_check;

bool check_instance_gates(XrInstance instance, XrSystemId system, bool listed, GazeGates& gates) {
    const std::int64_t now_ns = time::monotonic_ns();
    gates.set(GazeGate::Extension,
              {listed, listed ? "XR_EXT_eye_gaze_interaction"
                              : "XR_EXT_eye_gaze_interaction is not offered"},
              now_ns);
    if (!listed) {
        return false;
    }
    auto gaze = typed<XrSystemEyeGazeInteractionPropertiesEXT>(
        XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT);
    auto properties = typed<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
    properties.next = &gaze;
    xr_check(xrGetSystemProperties(instance, system, &properties), "xrGetSystemProperties");
    const bool supported = gaze.supportsEyeGazeInteraction == XR_TRUE;
    gates.set(GazeGate::System,
              {supported, supported ? "supportsEyeGazeInteraction is true"
                                    : "supportsEyeGazeInteraction is false"},
              now_ns);
    return supported;
}

EyeGazeAction::EyeGazeAction(XrInstance instance)
    : user_(path_of(instance, "/user/eyes_ext")),
      profile_(path_of(instance, "/interaction_profiles/ext/eye_gaze_interaction")) {
    auto set = typed<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
    std::strcpy(set.actionSetName, "gaze");
    std::strcpy(set.localizedActionSetName, "Gaze");
    xr_check(xrCreateActionSet(instance, &set, &set_), "xrCreateActionSet");
    auto action = typed<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
    action.actionType = XR_ACTION_TYPE_POSE_INPUT;
    std::strcpy(action.actionName, "eye_gaze");
    std::strcpy(action.localizedActionName, "Eye gaze");
    xr_check(xrCreateAction(set_, &action, &action_), "xrCreateAction");
    const XrActionSuggestedBinding binding{action_,
                                           path_of(instance, "/user/eyes_ext/input/gaze_ext/pose")};
    auto suggestion =
        typed<XrInteractionProfileSuggestedBinding>(XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
    suggestion.interactionProfile = profile_;
    suggestion.countSuggestedBindings = 1;
    suggestion.suggestedBindings = &binding;
    suggested_ = xrSuggestInteractionProfileBindings(instance, &suggestion);
}

EyeGazeAction::~EyeGazeAction() {
    if (set_ != XR_NULL_HANDLE) {
        xrDestroyActionSet(set_);  // and with it the action
    }
}

}  // namespace gazeloop::drivers
