#include "runtime/openxr/session.h"

#include <fmt/core.h>
#include <spdlog/spdlog.h>

#include <algorithm>
#include <array>
#include <cstring>
#include <iterator>
#include <limits>
#include <thread>

#include "runtime/error.h"

namespace gazeloop::openxr {
namespace {

constexpr auto kIdleWait = std::chrono::milliseconds(5);
constexpr int kPollsBeforeWarning = 1000;  // 5 s
constexpr auto kPatienceAtExit = std::chrono::seconds(5);

std::string_view state_name(XrSessionState state) {
    constexpr std::array<std::string_view, 9> kNames{"UNKNOWN",      "IDLE",         "READY",
                                                     "SYNCHRONIZED", "VISIBLE",      "FOCUSED",
                                                     "STOPPING",     "LOSS_PENDING", "EXITING"};
    const auto index = static_cast<std::size_t>(state);
    return index < kNames.size() ? kNames[index] : "?";
}

/// What a later step leaves behind when it throws goes with the instance.
XrSession create_session(const Instance& instance, const vulkan::Context& context) {
    auto binding = typed<XrGraphicsBindingVulkan2KHR>(XR_TYPE_GRAPHICS_BINDING_VULKAN2_KHR);
    binding.instance = *context.instance();
    binding.physicalDevice = *context.physical();
    binding.device = *context.device();
    binding.queueFamilyIndex = context.queue_family();
    binding.queueIndex = 0;
    auto info = typed<XrSessionCreateInfo>(XR_TYPE_SESSION_CREATE_INFO);
    info.next = &binding;
    info.systemId = instance.system();
    XrSession session = XR_NULL_HANDLE;
    xr_check(
        xrCreateSession(instance.handle(), &info, &session),
        "the runtime makes no session (another program may have the headset; the runtime's log "
        "may say more): xrCreateSession");
    return session;
}

XrSpace create_space(XrSession session, XrReferenceSpaceType type) {
    auto info = typed<XrReferenceSpaceCreateInfo>(XR_TYPE_REFERENCE_SPACE_CREATE_INFO);
    info.referenceSpaceType = type;
    info.poseInReferenceSpace = to_xr({});
    XrSpace space = XR_NULL_HANDLE;
    xr_check(xrCreateReferenceSpace(session, &info, &space), "xrCreateReferenceSpace");
    return space;
}

}  // namespace

Session::Session(const Instance& instance, const XrClock& clock, const vulkan::Context& context)
    : instance_(instance),
      clock_(clock),
      session_(create_session(instance, context)),
      local_space_(create_space(session_, XR_REFERENCE_SPACE_TYPE_LOCAL)),
      view_space_(create_space(session_, XR_REFERENCE_SPACE_TYPE_VIEW)) {}

Session::~Session() {
    xrDestroySpace(view_space_);
    xrDestroySpace(local_space_);
    xrDestroySession(session_);
}

Session::Activity Session::poll() {
    auto event = typed<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    while (xr_check_session(xrPollEvent(instance_.handle(), &event), "xrPollEvent") == XR_SUCCESS) {
        handle_event(event);
        event = typed<XrEventDataBuffer>(XR_TYPE_EVENT_DATA_BUFFER);
    }
    if (ended_) {
        return Activity::Ended;
    }
    if (exit_sent_ && std::chrono::steady_clock::now() > exit_deadline_) {
        tell(frame::kSessionOddEvent,
             fmt::format("{} does not end the session, which it was asked to: it was left",
                         instance_.runtime_name()));
        return Activity::Ended;
    }
    if (!running_) {
        if (exit_requested_ && !exit_sent_) {
            return Activity::Ended;  // no session runs that could be asked to end
        }
        if (++idle_polls_ == kPollsBeforeWarning) {
            spdlog::warn("{} wants no frames (yet): waiting; Ctrl-C ends",
                         instance_.runtime_name());
        }
        std::this_thread::sleep_for(kIdleWait);
        return Activity::Idle;
    }
    idle_polls_ = 0;
    return Activity::Running;
}

void Session::request_exit() {
    exit_requested_ = true;
    if (running_ && !exit_sent_) {
        xr_check_session(xrRequestExitSession(session_), "xrRequestExitSession");
        exit_sent_ = true;
        exit_deadline_ = std::chrono::steady_clock::now() + kPatienceAtExit;
    }
}

void Session::attach_actions() {
    if (action_sets_.empty() || actions_attached_) {
        return;
    }
    std::vector<XrActionSet> sets;
    std::ranges::transform(action_sets_, std::back_inserter(sets), &XrActiveActionSet::actionSet);
    auto attached = typed<XrSessionActionSetsAttachInfo>(XR_TYPE_SESSION_ACTION_SETS_ATTACH_INFO);
    attached.countActionSets = static_cast<std::uint32_t>(sets.size());
    attached.actionSets = sets.data();
    xr_check(xrAttachSessionActionSets(session_, &attached), "xrAttachSessionActionSets");
    actions_attached_ = true;
}

bool Session::sync_actions() const {
    auto info = typed<XrActionsSyncInfo>(XR_TYPE_ACTIONS_SYNC_INFO);
    info.countActiveActionSets = static_cast<std::uint32_t>(action_sets_.size());
    info.activeActionSets = action_sets_.data();
    return xr_check_session(xrSyncActions(session_, &info), "xrSyncActions") !=
           XR_SESSION_NOT_FOCUSED;
}

void Session::tell(const frame::EventKind& kind, std::string text) {
    events_.push_back({kind, std::move(text)});
}

void Session::handle_event(const XrEventDataBuffer& event) {
    switch (event.type) {
        case XR_TYPE_EVENT_DATA_INSTANCE_LOSS_PENDING:
            throw SetupError(ErrorKind::SessionLost,
                             fmt::format("OpenXR: {} is going away (instance loss pending): start "
                                         "again when it is back",
                                         instance_.runtime_name()));
        case XR_TYPE_EVENT_DATA_EVENTS_LOST:
            tell(frame::kEventsLostEvent,
                 "OpenXR events were lost: nobody knows what the runtime said in them");
            break;
        case XR_TYPE_EVENT_DATA_VISIBILITY_MASK_CHANGED_KHR:
            ++mask_changes_;
            tell(frame::kMaskEvent, "visibility mask changed");
            break;
        case XR_TYPE_EVENT_DATA_REFERENCE_SPACE_CHANGE_PENDING: {
            XrEventDataReferenceSpaceChangePending pending{};
            std::memcpy(&pending, &event, sizeof pending);
            move_origin(pending);
            break;
        }
        case XR_TYPE_EVENT_DATA_INTERACTION_PROFILE_CHANGED:
            ++profile_changes_;
            break;
        case XR_TYPE_EVENT_DATA_SESSION_STATE_CHANGED: {
            XrEventDataSessionStateChanged changed{};
            std::memcpy(&changed, &event, sizeof changed);
            change_state(changed);
            break;
        }
        default:
            break;
    }
}

void Session::move_origin(const XrEventDataReferenceSpaceChangePending& pending) {
    if (pending.referenceSpaceType != XR_REFERENCE_SPACE_TYPE_LOCAL) {
        return;  // nothing is placed in the others; each has an event of its own
    }
    const auto new_in_old = pending.poseValid == XR_TRUE ? from_xr(pending.poseInPreviousSpace)
                                                         : std::optional<gaze::Pose>{};
    // Where the time is none, frames have to show when it was.
    constexpr std::int64_t kFromNowOn = std::numeric_limits<std::int64_t>::min();
    new_origins_.push_back({clock_.host_ns(pending.changeTime).value_or(kFromNowOn), new_in_old});
    tell(frame::kOriginEvent,
         new_in_old ? "the runtime moves its origin: held gaze goes along"
                    : "the runtime moves its origin without saying where to: held gaze stays where "
                      "it is in the head");
}

void Session::change_state(const XrEventDataSessionStateChanged& changed) {
    state_ = changed.state;
    tell(frame::kSessionEvent, fmt::format("session state: {}", state_name(state_)));
    switch (state_) {
        case XR_SESSION_STATE_READY:
            begin();
            break;
        case XR_SESSION_STATE_STOPPING:
            end();
            break;
        case XR_SESSION_STATE_EXITING:
            ended_ = true;
            break;
        case XR_SESSION_STATE_LOSS_PENDING:
            throw SetupError(ErrorKind::SessionLost,
                             fmt::format("OpenXR: {} is losing the session (session loss "
                                         "pending): see that the headset is connected, then "
                                         "start again",
                                         instance_.runtime_name()));
        default:
            break;
    }
}

// Runtimes say the same state twice (Monado: STOPPING, once for each request to exit).

void Session::begin() {
    if (exit_requested_ || running_) {
        return;
    }
    auto info = typed<XrSessionBeginInfo>(XR_TYPE_SESSION_BEGIN_INFO);
    info.primaryViewConfigurationType = kStereo;
    xr_check_session(xrBeginSession(session_, &info), "xrBeginSession");
    running_ = true;
}

void Session::end() {
    if (!running_) {
        return;
    }
    running_ = false;
    xr_check_session(xrEndSession(session_), "xrEndSession");
}

std::optional<gaze::Pose> Session::head_at(XrTime time) const {
    auto location = typed<XrSpaceLocation>(XR_TYPE_SPACE_LOCATION);
    const XrResult result = xrLocateSpace(view_space_, local_space_, time, &location);
    if (result == XR_ERROR_TIME_INVALID) {
        return std::nullopt;  // so long ago that the runtime does not know any more
    }
    xr_check_session(result, "xrLocateSpace");
    constexpr XrSpaceLocationFlags kNeeded =
        XR_SPACE_LOCATION_ORIENTATION_VALID_BIT | XR_SPACE_LOCATION_POSITION_VALID_BIT;
    if ((location.locationFlags & kNeeded) != kNeeded) {
        return std::nullopt;
    }
    return from_xr(location.pose);
}

}  // namespace gazeloop::openxr
