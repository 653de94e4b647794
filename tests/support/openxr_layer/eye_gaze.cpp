// XR_EXT_eye_gaze_interaction from a file: GAZELOOP_OPENXR_GAZE names it. Its lines are samples,
// "SECONDS X Y Z": the time since the action was first synchronized, and a direction in the head.
// A pose is that of the last sample by kDelay before the time asked for, as from a runtime that
// predicts nothing.
// Effects:
//   xrGetSystemProperties:          no-eye-gaze
//   xrGetCurrentInteractionProfile: unbound
//   xrGetActionStatePose:           inactive
//   gaze (xrLocateSpace of the gaze's space): unseen (no valid pose), sub-nominal, nan-pose,
//       zero-pose, no-time (0), asked-time (predicted to the time asked), ahead (10 ms predicted),
//       still-time (always that of the first sample), negative-time, absurd-time (a year ahead)
#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <utility>
#include <vector>

#include "tests/support/openxr_layer/layer.h"

namespace gazeloop::tests {
namespace {

constexpr XrDuration kDelay = 5'000'000;
constexpr const char* kProfile = "/interaction_profiles/ext/eye_gaze_interaction";
constexpr const char* kEyes = "/user/eyes_ext";

struct Sample {
    XrDuration since_start;
    XrVector3f direction;
};

std::vector<Sample> read_samples() {
    std::vector<Sample> samples;
    const char* const name = std::getenv("GAZELOOP_OPENXR_GAZE");
    if (name == nullptr) {
        return samples;
    }
    std::ifstream file(name);
    double seconds = 0.0;
    XrVector3f direction{};
    while (file >> seconds >> direction.x >> direction.y >> direction.z) {
        samples.push_back({static_cast<XrDuration>(std::llround(seconds * 1e9)), direction});
    }
    if (samples.empty()) {
        refuse_fault("GAZELOOP_OPENXR_GAZE", name);
    }
    return samples;
}

struct EyeGaze {
    std::vector<Sample> samples = read_samples();
    XrAction action = XR_NULL_HANDLE;
    XrSpace space = XR_NULL_HANDLE;
    bool synchronized = false;
    XrTime start = 0;  ///< kDelay before the time that was first asked for
};

EyeGaze& eye_gaze() {
    static EyeGaze the_gaze;
    return the_gaze;
}

XrPath path_of(const char* text) {
    XrPath path = XR_NULL_PATH;
    next<PFN_xrStringToPath>("xrStringToPath")(layer().instance, text, &path);
    return path;
}

XRAPI_ATTR XrResult XRAPI_CALL get_system_properties(XrInstance instance, XrSystemId system,
                                                     XrSystemProperties* properties) {
    const auto effect = layer().plan.call("xrGetSystemProperties");
    if (effect && *effect != "no-eye-gaze") {
        refuse_fault("xrGetSystemProperties", *effect);
    }
    auto* const gaze = static_cast<XrSystemEyeGazeInteractionPropertiesEXT*>(properties->next);
    const bool asked =
        gaze != nullptr && gaze->type == XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT;
    properties->next = asked ? gaze->next : properties->next;
    const XrResult result =
        next<PFN_xrGetSystemProperties>("xrGetSystemProperties")(instance, system, properties);
    if (asked) {
        properties->next = gaze;
        gaze->supportsEyeGazeInteraction = effect ? XR_FALSE : XR_TRUE;
    }
    return result;
}

XRAPI_ATTR XrResult XRAPI_CALL
suggest_bindings(XrInstance instance, const XrInteractionProfileSuggestedBinding* suggested) {
    if (suggested->interactionProfile != path_of(kProfile)) {
        return next<PFN_xrSuggestInteractionProfileBindings>("xrSuggestInteractionProfileBindings")(
            instance, suggested);
    }
    if (const auto failure = failure_of("xrSuggestInteractionProfileBindings")) {
        return *failure;
    }
    if (suggested->countSuggestedBindings != 1 ||
        suggested->suggestedBindings[0].binding != path_of("/user/eyes_ext/input/gaze_ext/pose")) {
        return XR_ERROR_PATH_UNSUPPORTED;
    }
    eye_gaze().action = suggested->suggestedBindings[0].action;
    return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL create_action_space(XrSession session,
                                                   const XrActionSpaceCreateInfo* info,
                                                   XrSpace* space) {
    const XrResult result =
        next<PFN_xrCreateActionSpace>("xrCreateActionSpace")(session, info, space);
    if (XR_SUCCEEDED(result) && info->action == eye_gaze().action) {
        eye_gaze().space = *space;
    }
    return result;
}

XRAPI_ATTR XrResult XRAPI_CALL sync_actions(XrSession session, const XrActionsSyncInfo* info) {
    if (const auto failure = failure_of("xrSyncActions")) {
        return *failure;
    }
    const XrResult result = next<PFN_xrSyncActions>("xrSyncActions")(session, info);
    EyeGaze& gaze = eye_gaze();
    if (result == XR_SUCCESS && !std::exchange(gaze.synchronized, true)) {
        XrEventDataInteractionProfileChanged event{};
        event.type = XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED;
        event.session = session;
        send(event);
    }
    return result;
}

XRAPI_ATTR XrResult XRAPI_CALL get_current_profile(XrSession session, XrPath user,
                                                   XrInteractionProfileState* state) {
    if (user != path_of(kEyes)) {
        return next<PFN_xrGetCurrentInteractionProfile>("xrGetCurrentInteractionProfile")(
            session, user, state);
    }
    const auto effect = layer().plan.call("xrGetCurrentInteractionProfile");
    if (effect && *effect != "unbound") {
        refuse_fault("xrGetCurrentInteractionProfile", *effect);
    }
    state->interactionProfile =
        effect || !eye_gaze().synchronized ? XR_NULL_PATH : path_of(kProfile);
    return XR_SUCCESS;
}

XRAPI_ATTR XrResult XRAPI_CALL get_state(XrSession session, const XrActionStateGetInfo* info,
                                         XrActionStatePose* state) {
    if (info->action != eye_gaze().action) {
        return next<PFN_xrGetActionStatePose>("xrGetActionStatePose")(session, info, state);
    }
    const auto effect = layer().plan.call("xrGetActionStatePose");
    if (effect && *effect != "inactive") {
        refuse_fault("xrGetActionStatePose", *effect);
    }
    state->isActive = effect ? XR_FALSE : XR_TRUE;
    return XR_SUCCESS;
}

/// What turns -Z into the direction, without roll.
XrQuaternionf turn_to(const XrVector3f& direction) {
    const float length = std::hypot(direction.x, direction.y, direction.z);
    const float yaw = std::atan2(-direction.x, -direction.z) / 2.0F;
    const float pitch = std::asin(direction.y / length) / 2.0F;
    return {std::cos(yaw) * std::sin(pitch), std::sin(yaw) * std::cos(pitch),
            -std::sin(yaw) * std::sin(pitch), std::cos(yaw) * std::cos(pitch)};
}

void spoil(std::string_view effect, XrTime asked, XrSpaceLocation& location, XrTime& time) {
    constexpr XrTime kYear = 31'557'600'000'000'000;
    constexpr XrDuration kPrediction = 10'000'000;
    if (effect == "unseen") {
        location.locationFlags = 0;
    } else if (effect == "sub-nominal") {
        location.locationFlags &= ~XrSpaceLocationFlags{XR_SPACE_LOCATION_POSITION_TRACKED_BIT};
    } else if (effect == "nan-pose") {
        location.pose.orientation.w = std::numeric_limits<float>::quiet_NaN();
    } else if (effect == "zero-pose") {
        location.pose.orientation = {};
    } else if (effect == "no-time") {
        time = 0;
    } else if (effect == "asked-time") {
        time = asked;
    } else if (effect == "ahead") {
        time = asked + kPrediction;
    } else if (effect == "still-time") {
        time = eye_gaze().start;
    } else if (effect == "negative-time") {
        time = -1;
    } else if (effect == "absurd-time") {
        time = asked + kYear;
    } else {
        refuse_fault("gaze", effect);
    }
}

}  // namespace

bool provides_eye_gaze() { return !eye_gaze().samples.empty(); }

std::optional<XrResult> locate_gaze(XrSpace space, XrTime asked, XrSpaceLocation* location) {
    EyeGaze& gaze = eye_gaze();
    if (space != gaze.space || space == XR_NULL_HANDLE) {
        return std::nullopt;
    }
    const auto effect = layer().plan.call("gaze");
    if (const auto result = effect ? result_named(*effect) : std::nullopt) {
        return result;
    }
    if (gaze.start == 0) {
        gaze.start = asked - kDelay;
    }
    const auto later = std::ranges::upper_bound(gaze.samples, asked - kDelay - gaze.start, {},
                                                &Sample::since_start);
    const Sample& sample = later == gaze.samples.begin() ? *later : *std::prev(later);
    location->locationFlags =
        XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT |
        XR_SPACE_LOCATION_ORIENTATION_TRACKED_BIT | XR_SPACE_LOCATION_POSITION_TRACKED_BIT;
    location->pose = {turn_to(sample.direction), {0.0F, 0.0F, 0.0F}};
    XrTime time = gaze.start + sample.since_start;
    if (effect) {
        spoil(*effect, asked, *location, time);
    }
    auto* const sample_time = static_cast<XrEyeGazeSampleTimeEXT*>(location->next);
    if (sample_time != nullptr && sample_time->type == XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT) {
        sample_time->time = time;
    }
    return XR_SUCCESS;
}

PFN_xrVoidFunction eye_gaze_hook(std::string_view name) {
    if (!provides_eye_gaze()) {
        return nullptr;
    }
    if (name == "xrGetSystemProperties") {
        return as_hook(&get_system_properties);
    }
    if (name == "xrSuggestInteractionProfileBindings") {
        return as_hook(&suggest_bindings);
    }
    if (name == "xrCreateActionSpace") {
        return as_hook(&create_action_space);
    }
    if (name == "xrSyncActions") {
        return as_hook(&sync_actions);
    }
    if (name == "xrGetCurrentInteractionProfile") {
        return as_hook(&get_current_profile);
    }
    return name == "xrGetActionStatePose" ? as_hook(&get_state) : nullptr;
}

}  // namespace gazeloop::tests
