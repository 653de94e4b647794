// Controllers whose buttons somebody presses: all actions of a truth value are bound. The function
// of a fault is the action's name, counted each time its state is asked for. Effects:
//   down:      the button is held
//   inactive:  nothing is bound to it now
#include <map>
#include <string>

#include "tests/support/openxr_layer/layer.h"

namespace gazeloop::tests {
namespace {

std::map<XrAction, std::string>& buttons() {
    static std::map<XrAction, std::string> the_buttons;
    return the_buttons;
}

XRAPI_ATTR XrResult XRAPI_CALL create_action(XrActionSet set, const XrActionCreateInfo* info,
                                             XrAction* action) {
    const XrResult result = next<PFN_xrCreateAction>("xrCreateAction")(set, info, action);
    if (XR_SUCCEEDED(result) && info->actionType == XR_ACTION_TYPE_BOOLEAN_INPUT) {
        buttons()[*action] = static_cast<const char*>(info->actionName);
    }
    return result;
}

XRAPI_ATTR XrResult XRAPI_CALL get_button(XrSession session, const XrActionStateGetInfo* info,
                                          XrActionStateBoolean* state) {
    if (const auto failure = failure_of("xrGetActionStateBoolean")) {
        return *failure;
    }
    const XrResult result =
        next<PFN_xrGetActionStateBoolean>("xrGetActionStateBoolean")(session, info, state);
    const auto button = buttons().find(info->action);
    if (XR_FAILED(result) || button == buttons().end()) {
        return result;
    }
    const auto effect = layer().plan.call(button->second);
    if (effect && *effect != "down" && *effect != "inactive") {
        refuse_fault(button->second, *effect);
    }
    state->isActive = effect && *effect == "inactive" ? XR_FALSE : XR_TRUE;
    state->currentState = effect && *effect == "down" ? XR_TRUE : XR_FALSE;
    return result;
}

}  // namespace

PFN_xrVoidFunction button_hook(std::string_view name) {
    if (name == "xrCreateAction") {
        return as_hook(&create_action);
    }
    return name == "xrGetActionStateBoolean" ? as_hook(&get_button) : nullptr;
}

}  // namespace gazeloop::tests
