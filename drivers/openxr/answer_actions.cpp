#include "drivers/openxr/answer_actions.h"

#include <fmt/core.h>

#include <cstring>
#include <vector>

#include "runtime/error.h"

namespace gazeloop::drivers {
namespace {

using openxr::path_of;
using openxr::typed;
using openxr::xr_check;
using openxr::xr_check_session;

/// Of one kind of controller: what each button is; null: it has none for it.
struct ControllerButtons {
    const char* profile;
    std::array<const char*, present::kButtonCount> paths;
};

/// The interaction profiles of OpenXR 1.0's section 6.4 that have buttons.
constexpr std::array<ControllerButtons, 6> kControllers{{
    {"/interaction_profiles/khr/simple_controller",
     {"/user/hand/right/input/select/click", "/user/hand/left/input/select/click",
      "/user/hand/right/input/menu/click", "/user/hand/left/input/menu/click", nullptr, nullptr}},
    {"/interaction_profiles/oculus/touch_controller",
     {"/user/hand/right/input/a/click", "/user/hand/right/input/b/click",
      "/user/hand/left/input/x/click", "/user/hand/left/input/y/click",
      "/user/hand/right/input/thumbstick/click", "/user/hand/left/input/menu/click"}},
    {"/interaction_profiles/valve/index_controller",
     {"/user/hand/right/input/a/click", "/user/hand/right/input/b/click",
      "/user/hand/left/input/a/click", "/user/hand/left/input/b/click",
      "/user/hand/right/input/thumbstick/click", "/user/hand/left/input/thumbstick/click"}},
    {"/interaction_profiles/htc/vive_controller",
     {"/user/hand/right/input/trigger/click", "/user/hand/left/input/trigger/click",
      "/user/hand/right/input/squeeze/click", "/user/hand/left/input/squeeze/click",
      "/user/hand/right/input/menu/click", "/user/hand/left/input/menu/click"}},
    {"/interaction_profiles/microsoft/motion_controller",
     {"/user/hand/right/input/trigger/value", "/user/hand/left/input/trigger/value",
      "/user/hand/right/input/squeeze/click", "/user/hand/left/input/squeeze/click",
      "/user/hand/right/input/menu/click", "/user/hand/left/input/menu/click"}},
    {"/interaction_profiles/microsoft/xbox_controller",
     {"/user/gamepad/input/a/click", "/user/gamepad/input/b/click", "/user/gamepad/input/x/click",
      "/user/gamepad/input/y/click", "/user/gamepad/input/shoulder_right/click",
      "/user/gamepad/input/menu/click"}},
}};

}  // namespace

AnswerActions::AnswerActions(openxr::Session& session) : session_(session) {
    auto set = typed<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
    std::strcpy(set.actionSetName, "answers");
    std::strcpy(set.localizedActionSetName, "Answers");
    xr_check(xrCreateActionSet(session.instance().handle(), &set, &set_), "xrCreateActionSet");
    for (std::size_t button = 0; button < present::kButtonCount; ++button) {
        auto action = typed<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
        action.actionType = XR_ACTION_TYPE_BOOLEAN_INPUT;
        const std::string name(present::kButtonNames[button]);
        std::strcpy(action.actionName, name.c_str());
        std::strcpy(action.localizedActionName, ("Answer: " + name).c_str());
        xr_check(xrCreateAction(set_, &action, &actions_[button]), "xrCreateAction");
    }
    suggest_bindings();
    session.add_actions(set_);
}

AnswerActions::~AnswerActions() {
    if (set_ != XR_NULL_HANDLE) {
        xrDestroyActionSet(set_);  // and with it the actions
    }
}

void AnswerActions::suggest_bindings() const {
    const XrInstance instance = session_.instance().handle();
    bool any = false;
    XrResult last = XR_SUCCESS;
    for (const ControllerButtons& controller : kControllers) {
        std::vector<XrActionSuggestedBinding> bindings;
        for (std::size_t button = 0; button < present::kButtonCount; ++button) {
            if (controller.paths[button] != nullptr) {
                bindings.push_back({actions_[button], path_of(instance, controller.paths[button])});
            }
        }
        auto suggestion = typed<XrInteractionProfileSuggestedBinding>(
            XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
        suggestion.interactionProfile = path_of(instance, controller.profile);
        suggestion.countSuggestedBindings = static_cast<std::uint32_t>(bindings.size());
        suggestion.suggestedBindings = bindings.data();
        // A runtime need not know every controller.
        last = xrSuggestInteractionProfileBindings(instance, &suggestion);
        any = any || XR_SUCCEEDED(last);
    }
    if (!any) {
        throw SetupError(ErrorKind::NoDevice,
                         fmt::format("{} takes no bindings for answers by controller ({})",
                                     session_.instance().runtime_name(), openxr::xr_name(last)));
    }
}

bool AnswerActions::is_down(XrAction action) const {
    auto get = typed<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
    get.action = action;
    auto state = typed<XrActionStateBoolean>(XR_TYPE_ACTION_STATE_BOOLEAN);
    xr_check_session(xrGetActionStateBoolean(session_.handle(), &get, &state),
                     "xrGetActionStateBoolean");
    return state.isActive == XR_TRUE && state.currentState == XR_TRUE;
}

void AnswerActions::take(std::vector<present::Pressed>& pressed) {
    if (!session_.sync_actions()) {
        edges_.forget();
        return;
    }
    for (std::size_t button = 0; button < present::kButtonCount; ++button) {
        const auto which = static_cast<present::Button>(button);
        if (edges_.pressed(which, is_down(actions_[button]))) {
            pressed.emplace_back(which);
        }
    }
}

}  // namespace gazeloop::drivers
