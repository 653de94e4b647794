// What a runtime may do to a session and its frames. Effects:
//   xrWaitFrame:   hidden (shouldRender = 0), display+MS, display-MS (moves the announced time),
//                  display=NS, period=NS, exit (the runtime is asked to end the session), pause (it
//                  stops the session and lets it begin again 20 polls later), event:STATE (a
//                  session state), event:INSTANCE_LOSS_PENDING, event:VISIBILITY_MASK_CHANGED,
//                  recentre=DEG and the like (moved_origin.cpp)
//   xrGetVulkanGraphicsRequirements2KHR: newer (wants a Vulkan that does not exist yet)
//   xrEndSession:  silence (from then on the runtime has no events), again (it says once more that
//                  the session is stopping)
//   xrLocateViews: untracked (no valid pose), nan-pose, zero-pose (a quaternion of zeros), nan-fov,
//                  flat-fov (all angles 0), wide-fov (a right angle to each side)
//   xrLocateSpace: untracked, nan-pose; the gaze's space is not counted (eye_gaze.cpp)
#include <charconv>
#include <cmath>
#include <limits>

#include "tests/support/openxr_layer/layer.h"
// After what it needs.
#include <openxr/openxr_reflection.h>

namespace gazeloop::tests {
namespace {

constexpr int kPollsOfAPause = 20;

bool g_paused = false;
bool g_silent = false;
int g_polls_until_ready = 0;
XrTime g_announced = 0;  // by the runtime, for the frame that is under way
XrTime g_passed_on = 0;  // what the program was told in its place

XrSessionState state_named(std::string_view text) {
#define GAZELOOP_STATE(name, value)                                                 \
    if (std::string_view(#name).substr(std::strlen("XR_SESSION_STATE_")) == text) { \
        return name;                                                                \
    }
    XR_LIST_ENUM_XrSessionState(GAZELOOP_STATE)
#undef GAZELOOP_STATE
        refuse_fault("xrWaitFrame: event", text);
}

std::int64_t whole_number(std::string_view function, std::string_view text) {
    std::int64_t value = 0;
    if (!text.empty() && text.front() == '+') {
        text.remove_prefix(1);
    }
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc{} || end != text.data() + text.size()) {
        refuse_fault(function, text);
    }
    return value;
}

void send_state(XrSessionState state) {
    XrEventDataSessionStateChanged event{};
    event.type = XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED;
    event.session = layer().session;
    event.state = state;
    send(event);
}

XRAPI_ATTR XrResult XRAPI_CALL vulkan_requirements(XrInstance instance, XrSystemId system,
                                                   XrGraphicsRequirementsVulkan2KHR* wanted) {
    constexpr const char* kName = "xrGetVulkanGraphicsRequirements2KHR";
    const XrResult result =
        next<PFN_xrGetVulkanGraphicsRequirements2KHR>(kName)(instance, system, wanted);
    if (const auto effect = layer().plan.call(kName)) {
        if (*effect != "newer") {
            refuse_fault(kName, *effect);
        }
        wanted->minApiVersionSupported = XR_MAKE_VERSION(9, 7, 0);
    }
    return result;
}

/// A function that can only fail.
template <auto Name, typename... Arguments>
XRAPI_ATTR XrResult XRAPI_CALL failing(Arguments... arguments) {
    if (const auto failure = failure_of(Name())) {
        return *failure;
    }
    return next<XrResult(XRAPI_PTR*)(Arguments...)>(Name())(arguments...);
}

template <auto Name, typename... Arguments>
PFN_xrVoidFunction failing_as(XrResult(XRAPI_PTR*)(Arguments...)) {
    return reinterpret_cast<PFN_xrVoidFunction>(&failing<Name, Arguments...>);
}

XRAPI_ATTR XrResult XRAPI_CALL poll_event(XrInstance instance, XrEventDataBuffer* event) {
    Layer& l = layer();
    if (const auto failure = failure_of("xrPollEvent")) {
        return *failure;
    }
    if (g_polls_until_ready > 0) {
        --g_polls_until_ready;
        if (g_polls_until_ready == 0) {
            send_state(XR_SESSION_STATE_READY);
        }
    }
    if (!l.events.empty()) {
        *event = l.events.front();
        l.events.pop_front();
        return XR_SUCCESS;
    }
    return g_silent ? XR_EVENT_UNAVAILABLE : next<PFN_xrPollEvent>("xrPollEvent")(instance, event);
}

/// The runtime knows nothing of a pause that the layer makes.
XRAPI_ATTR XrResult XRAPI_CALL end_session(XrSession session) {
    if (const auto effect = layer().plan.call("xrEndSession")) {
        if (*effect == "again") {
            send_state(XR_SESSION_STATE_STOPPING);
        } else if (*effect == "silence") {
            g_silent = true;
        } else {
            refuse_fault("xrEndSession", *effect);
        }
    }
    if (g_paused) {
        send_state(XR_SESSION_STATE_IDLE);
        g_polls_until_ready = kPollsOfAPause;
        return XR_SUCCESS;
    }
    return next<PFN_xrEndSession>("xrEndSession")(session);
}

XRAPI_ATTR XrResult XRAPI_CALL begin_session(XrSession session, const XrSessionBeginInfo* info) {
    if (g_paused) {
        g_paused = false;
        return XR_SUCCESS;
    }
    return next<PFN_xrBeginSession>("xrBeginSession")(session, info);
}

void after_wait(std::string_view effect, XrFrameState& state) {
    constexpr std::string_view kEvent = "event:";
    constexpr std::string_view kDisplay = "display";
    constexpr std::string_view kPeriod = "period=";
    if (effect == "hidden") {
        state.shouldRender = XR_FALSE;
    } else if (effect == "exit") {
        next<PFN_xrRequestExitSession>("xrRequestExitSession")(layer().session);
    } else if (effect == "pause") {
        g_paused = true;
        send_state(XR_SESSION_STATE_STOPPING);
    } else if (effect == "event:INSTANCE_LOSS_PENDING") {
        XrEventDataInstanceLossPending event{};
        event.type = XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING;
        send(event);
    } else if (effect == "event:VISIBILITY_MASK_CHANGED") {
        XrEventDataVisibilityMaskChangedKHR event{};
        event.type = XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR;
        event.session = layer().session;
        event.viewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
        send(event);
    } else if (move_origin(effect, state)) {
        return;
    } else if (effect.starts_with(kEvent)) {
        send_state(state_named(effect.substr(kEvent.size())));
    } else if (effect.starts_with("display=")) {
        state.predictedDisplayTime = whole_number("xrWaitFrame", effect.substr(8));
    } else if (effect.starts_with(kDisplay)) {
        state.predictedDisplayTime +=
            whole_number("xrWaitFrame", effect.substr(kDisplay.size())) * 1'000'000;
    } else if (effect.starts_with(kPeriod)) {
        state.predictedDisplayPeriod = whole_number("xrWaitFrame", effect.substr(kPeriod.size()));
    } else {
        refuse_fault("xrWaitFrame", effect);
    }
}

/// The runtime is not to wait for a time that it did not announce.
XRAPI_ATTR XrResult XRAPI_CALL end_frame(XrSession session, const XrFrameEndInfo* info) {
    if (const auto failure = failure_of("xrEndFrame")) {
        return *failure;
    }
    if (info->displayTime <= 0 || (g_passed_on > 0 && info->displayTime != g_passed_on)) {
        return XR_ERROR_TIME_INVALID;  // a runtime wants its own time back, if it gave one
    }
    XrFrameEndInfo as_announced = *info;
    as_announced.displayTime = g_announced;
    return next<PFN_xrEndFrame>("xrEndFrame")(session, &as_announced);
}

XRAPI_ATTR XrResult XRAPI_CALL wait_frame(XrSession session, const XrFrameWaitInfo* info,
                                          XrFrameState* state) {
    layer().session = session;
    const auto effect = layer().plan.call("xrWaitFrame");
    if (const auto result = effect ? result_named(*effect) : std::nullopt) {
        return *result;
    }
    const XrResult result = next<PFN_xrWaitFrame>("xrWaitFrame")(session, info, state);
    g_announced = state->predictedDisplayTime;
    if (effect && XR_SUCCEEDED(result)) {
        after_wait(*effect, *state);
    }
    g_passed_on = state->predictedDisplayTime;
    return result;
}

XRAPI_ATTR XrResult XRAPI_CALL locate_views(XrSession session, const XrViewLocateInfo* info,
                                            XrViewState* state, std::uint32_t capacity,
                                            std::uint32_t* count, XrView* views) {
    const auto effect = layer().plan.call("xrLocateViews");
    if (const auto result = effect ? result_named(*effect) : std::nullopt) {
        return *result;
    }
    const XrResult result =
        next<PFN_xrLocateViews>("xrLocateViews")(session, info, state, capacity, count, views);
    if (XR_SUCCEEDED(result)) {
        for (std::uint32_t i = 0; i < *count && i < capacity; ++i) {
            views[i].pose = in_moved_space(views[i].pose, info->space, info->displayTime);
        }
    }
    if (!effect || XR_FAILED(result)) {
        return result;
    }
    constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
    constexpr float kRightAngle = 1.57079637F;
    if (*effect == "untracked") {
        state->viewStateFlags = 0;
    }
    for (std::uint32_t i = 0; i < *count && i < capacity; ++i) {
        if (*effect == "nan-pose") {
            views[i].pose = {{kNan, 0.0F, 0.0F, 1.0F}, {0.0F, kNan, 0.0F}};
        } else if (*effect == "zero-pose") {
            views[i].pose.orientation = {};
        } else if (*effect == "nan-fov") {
            views[i].fov.angleUp = kNan;
        } else if (*effect == "flat-fov") {
            views[i].fov = {};
        } else if (*effect == "wide-fov") {
            views[i].fov = {-kRightAngle, kRightAngle, kRightAngle, -kRightAngle};
        } else if (*effect != "untracked") {
            refuse_fault("xrLocateViews", *effect);
        }
    }
    return result;
}

XRAPI_ATTR XrResult XRAPI_CALL locate_space(XrSpace space, XrSpace base, XrTime time,
                                            XrSpaceLocation* location) {
    if (const auto located = locate_gaze(space, time, location)) {
        return *located;
    }
    const auto effect = layer().plan.call("xrLocateSpace");
    if (const auto result = effect ? result_named(*effect) : std::nullopt) {
        return *result;
    }
    const XrResult result = next<PFN_xrLocateSpace>("xrLocateSpace")(space, base, time, location);
    if (XR_SUCCEEDED(result)) {
        location->pose = in_moved_space(location->pose, base, time);
    }
    if (effect && XR_SUCCEEDED(result)) {
        if (*effect == "untracked") {
            location->locationFlags = 0;
        } else if (*effect == "nan-pose") {
            location->pose.orientation.w = std::numeric_limits<float>::quiet_NaN();
        } else {
            refuse_fault("xrLocateSpace", *effect);
        }
    }
    return result;
}

}  // namespace

PFN_xrVoidFunction frame_hook(std::string_view wanted) {
#define GAZELOOP_FAILING(function_name)                                          \
    if (wanted == #function_name) {                                              \
        return failing_as<[] { return #function_name; }>(PFN_##function_name{}); \
    }
    GAZELOOP_FAILING(xrCreateSession)
    GAZELOOP_FAILING(xrCreateSwapchain)
    GAZELOOP_FAILING(xrRequestExitSession)
    GAZELOOP_FAILING(xrBeginFrame)
    GAZELOOP_FAILING(xrAcquireSwapchainImage)
    GAZELOOP_FAILING(xrWaitSwapchainImage)
    GAZELOOP_FAILING(xrReleaseSwapchainImage)
    GAZELOOP_FAILING(xrConvertTimespecTimeToTimeKHR)
#undef GAZELOOP_FAILING
    if (wanted == "xrGetVulkanGraphicsRequirements2KHR") {
        return as_hook(&vulkan_requirements);
    }
    if (wanted == "xrPollEvent") {
        return as_hook(&poll_event);
    }
    if (wanted == "xrBeginSession") {
        return as_hook(&begin_session);
    }
    if (wanted == "xrEndSession") {
        return as_hook(&end_session);
    }
    if (wanted == "xrWaitFrame") {
        return as_hook(&wait_frame);
    }
    if (wanted == "xrEndFrame") {
        return as_hook(&end_frame);
    }
    if (wanted == "xrLocateViews") {
        return as_hook(&locate_views);
    }
    return wanted == "xrLocateSpace" ? as_hook(&locate_space) : nullptr;
}

}  // namespace gazeloop::tests
