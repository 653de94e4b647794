#include "tests/openxr/layered_application.h"

#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <thread>

#include "runtime/time/clock.h"
#include "tests/support/cache_folder.h"

namespace gazeloop::tests {

using openxr::typed;
using openxr::xr_check;

LayeredHome::LayeredHome(const std::vector<std::string>& settings) {
    std::string lines;
    for (const std::string& setting : settings) {
        lines += setting + "\n";
    }
    const std::string layer = std::string(GAZELOOP_BINARY_DIR) + "/openxr_layer";
    const std::string home = folder_.file("home");
    for (const auto& [name, value] : std::vector<std::pair<const char*, std::string>>{
             {"XR_RUNTIME_JSON", cache_folder() + "/monado/share/openxr/1/openxr_monado.json"},
             {"XDG_CONFIG_HOME", home + "/config"},
             {"XDG_STATE_HOME", home + "/state"},
             {"XDG_DATA_HOME", home + "/data"},
             {"XR_API_LAYER_PATH", layer + ":/usr/share/openxr/1/api_layers/explicit.d"},
             {"XR_ENABLE_API_LAYERS", "XR_APILAYER_GAZELOOP_gaze"},
             {"GAZELOOP_LAYER_SETTINGS", lines},
             {"SIMULATED_ENABLE", "1"},
             {"XRT_COMPOSITOR_NULL", "1"},
             {"XRT_NO_STDIN", "1"},
             {"XRT_LOG", "error"},
             {"XRT_COMPOSITOR_LOG", "error"},
             {"PROBER_LOG", "warn"},
             {"SIMULATED_LOG", "warn"},
             {"OXR_NO_PRINTING", "1"}}) {
        setenv(name, value.c_str(), 1);
    }
}

std::string LayeredHome::log() const {
    std::ifstream in(folder_.file("home/state/gazeloop/layer/layer.log"));
    return {std::istreambuf_iterator<char>(in), {}};
}

void LayeredHome::write_config(const std::string& name, const std::string& text) const {
    const std::filesystem::path folder = folder_.file("home/config/gazeloop");
    std::filesystem::create_directories(folder);
    std::ofstream(folder / name) << text;
}

LayeredApplication::LayeredApplication(const std::vector<const char*>& more) {
    std::vector<const char*> extensions{"XR_MND_headless",
                                        XR_KHR_CONVERT_TIMESPEC_TIME_EXTENSION_NAME,
                                        XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME};
    extensions.insert(extensions.end(), more.begin(), more.end());
    auto info = typed<XrInstanceCreateInfo>(XR_TYPE_INSTANCE_CREATE_INFO);
    std::strcpy(info.applicationInfo.applicationName, "a stranger");
    info.applicationInfo.apiVersion = XR_MAKE_VERSION(1, 0, 0);
    info.enabledExtensionCount = static_cast<std::uint32_t>(extensions.size());
    info.enabledExtensionNames = extensions.data();
    xr_check(xrCreateInstance(&info, &instance_), "xrCreateInstance");
    auto get = typed<XrSystemGetInfo>(XR_TYPE_SYSTEM_GET_INFO);
    get.formFactor = XR_FORM_FACTOR_HEAD_MOUNTED_DISPLAY;
    xr_check(xrGetSystem(instance_, &get, &system_), "xrGetSystem");
    auto session = typed<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
    session.systemId = system_;
    xr_check(xrCreateSession(instance_, &session, &session_), "xrCreateSession");
    // NOLINTNEXTLINE(cppcoreguidelines-prefer-member-initializer): of the instance made here
    to_xr_time_ = openxr::xr_function<PFN_xrConvertTimespecTimeToTimeKHR>(
        instance_, "xrConvertTimespecTimeToTimeKHR");
}

LayeredApplication::~LayeredApplication() {
    xrDestroySession(session_);
    xrDestroyInstance(instance_);
}

XrPath LayeredApplication::path(const char* text) const {
    XrPath path = XR_NULL_PATH;
    xr_check(xrStringToPath(instance_, text, &path), text);
    return path;
}

bool LayeredApplication::supports_eye_gaze() const {
    auto eyes = typed<XrSystemEyeGazeInteractionPropertiesEXT>(
        XR_TYPE_SYSTEM_EYE_GAZE_INTERACTION_PROPERTIES_EXT);
    auto properties = typed<XrSystemProperties>(XR_TYPE_SYSTEM_PROPERTIES);
    properties.next = &eyes;
    xr_check(xrGetSystemProperties(instance_, system_, &properties), "xrGetSystemProperties");
    return eyes.supportsEyeGazeInteraction == XR_TRUE;
}

XrTime LayeredApplication::now() const {
    const std::int64_t now_ns = time::monotonic_ns();
    const timespec host{now_ns / 1'000'000'000, now_ns % 1'000'000'000};
    XrTime time = 0;
    xr_check(to_xr_time_(instance_, &host, &time), "xrConvertTimespecTimeToTimeKHR");
    return time;
}

EyeAction LayeredApplication::make_action(const char* name, std::uint32_t priority, bool for_eyes) {
    EyeAction made;
    auto set = typed<XrActionSetCreateInfo>(XR_TYPE_ACTION_SET_CREATE_INFO);
    std::strcpy(set.actionSetName, name);
    std::strcpy(set.localizedActionSetName, name);
    set.priority = priority;
    xr_check(xrCreateActionSet(instance_, &set, &made.set), "xrCreateActionSet");
    auto action = typed<XrActionCreateInfo>(XR_TYPE_ACTION_CREATE_INFO);
    std::strcpy(action.actionName, name);
    std::strcpy(action.localizedActionName, name);
    action.actionType = XR_ACTION_TYPE_POSE_INPUT;
    const XrPath eyes = path("/user/eyes_ext");
    action.countSubactionPaths = for_eyes ? 1 : 0;
    action.subactionPaths = for_eyes ? &eyes : nullptr;
    xr_check(xrCreateAction(made.set, &action, &made.action), "xrCreateAction");
    return made;
}

XrResult LayeredApplication::suggest(const std::vector<XrAction>& actions, const char* binding) {
    std::vector<XrActionSuggestedBinding> bindings;
    bindings.reserve(actions.size());
    for (const XrAction action : actions) {
        bindings.push_back({action, path(binding)});
    }
    auto suggested =
        typed<XrInteractionProfileSuggestedBinding>(XR_TYPE_INTERACTION_PROFILE_SUGGESTED_BINDING);
    suggested.interactionProfile = path("/interaction_profiles/ext/eye_gaze_interaction");
    suggested.countSuggestedBindings = static_cast<std::uint32_t>(bindings.size());
    suggested.suggestedBindings = bindings.data();
    return xrSuggestInteractionProfileBindings(instance_, &suggested);
}

void LayeredApplication::begin(const std::vector<XrActionSet>& attached) {
    auto attach = typed<XrSessionActionSetsAttachInfo>(XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
    attach.countActionSets = static_cast<std::uint32_t>(attached.size());
    attach.actionSets = attached.data();
    xr_check(xrAttachSessionActionSets(session_, &attach), "xrAttachSessionActionSets");
    const std::int64_t deadline_ns = time::monotonic_ns() + 10'000'000'000;
    bool begun = false;
    while (state_ != XR_SESSION_STATE_FOCUSED) {
        take_events();
        if (state_ == XR_SESSION_STATE_READY && !begun) {
            auto info = typed<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
            info.primaryViewConfigurationType = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;
            xr_check(xrBeginSession(session_, &info), "xrBeginSession");
            begun = true;
        }
        if (time::monotonic_ns() > deadline_ns) {
            throw std::runtime_error("the session never had the focus");
        }
        std::this_thread::sleep_for(std::chrono::milliseconds(2));
    }
}

XrSpace LayeredApplication::gaze_space(XrAction action, XrPath user) {
    auto info = typed<XrActionSpaceCreateInfo>(XR_TYPE_ACTION_SPACE_CREATE_INFO);
    info.action = action;
    info.subactionPath = user;
    info.poseInActionSpace = openxr::to_xr({});
    XrSpace space = XR_NULL_HANDLE;
    xr_check(xrCreateActionSpace(session_, &info, &space), "xrCreateActionSpace");
    return space;
}

XrSpace LayeredApplication::reference_space(XrReferenceSpaceType type) {
    auto info = typed<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
    info.referenceSpaceType = type;
    info.poseInReferenceSpace = openxr::to_xr({});
    XrSpace space = XR_NULL_HANDLE;
    xr_check(xrCreateReferenceSpace(session_, &info, &space), "xrCreateReferenceSpace");
    return space;
}

XrResult LayeredApplication::sync(const std::vector<XrActiveActionSet>& sets) {
    auto info = typed<XrActionsSyncInfo>(XR_TYPE_ACTIONS_SYNC_INFO);
    info.countActiveActionSets = static_cast<std::uint32_t>(sets.size());
    info.activeActionSets = sets.data();
    return xrSyncActions(session_, &info);
}

bool LayeredApplication::active(XrAction action, XrPath user) const {
    auto info = typed<XrActionStateGetInfo>(XR_TYPE_ACTION_STATE_GET_INFO);
    info.action = action;
    info.subactionPath = user;
    auto state = typed<XrActionStatePose>(XR_TYPE_ACTION_STATE_POSE);
    xr_check(xrGetActionStatePose(session_, &info, &state), "xrGetActionStatePose");
    return state.isActive == XR_TRUE;
}

SaidGaze LayeredApplication::locate(XrSpace space, XrSpace base, XrTime time) const {
    SaidGaze said;
    said.sample.type = XR_TYPE_GAZE_SAMPLE_GAZELOOP;
    auto sample_time = typed<XrEyeGazeSampleTimeEXT>(XR_TYPE_EYE_GAZE_SAMPLE_TIME_EXT);
    sample_time.next = &said.sample;
    sample_time.time = -1;
    auto velocity = typed<XrSpaceVelocity>(XR_TYPE_SPACE_VELOCITY);
    velocity.next = &sample_time;
    auto location = typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
    location.next = &velocity;
    said.result = xrLocateSpace(space, base, time, &location);
    said.flags = location.locationFlags;
    said.pose = location.pose;
    said.velocity_flags = velocity.velocityFlags;
    said.angular = velocity.angularVelocity;
    said.time = sample_time.time;
    return said;
}

void LayeredApplication::sync_for(const EyeAction& action, double seconds) {
    const std::int64_t until_ns = time::monotonic_ns() + static_cast<std::int64_t>(seconds * 1e9);
    do {
        xr_check(sync({{action.set, XR_NULL_PATH}}), "xrSyncActions");
        std::this_thread::sleep_for(std::chrono::milliseconds(5));
    } while (time::monotonic_ns() < until_ns);
}

void LayeredApplication::take_events() {
    auto event = typed<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    while (xrPollEvent(instance_, &event) == XR_SUCCESS) {
        if (event.type == XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED) {
            XrEventDataSessionStateChanged changed{};
            std::memcpy(&changed, &event, sizeof changed);
            state_ = changed.state;
        }
        profile_changes_ += event.type == XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED ? 1U : 0U;
        event = typed<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    }
}

std::size_t LayeredApplication::profile_changes() {
    take_events();
    return std::exchange(profile_changes_, 0);
}

}  // namespace gazeloop::tests
