#pragma once

#include <chrono>
#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/frame/event.h"
#include "runtime/gaze/origin_change.h"
#include "runtime/openxr/instance.h"
#include "runtime/openxr/xr_clock.h"
#include "runtime/vulkan/context.h"

namespace gazeloop::openxr {

inline constexpr XrViewConfigurationType kStereo = XR_VIEW_CONFIGURATION_TYPE_PRIMARY_STEREO;

/// The stereo session that pictures and gaze share: its state, its spaces, and what the runtime
/// says of it. What is given to the constructor must outlive it.
class Session {
  public:
    /// Throws SetupError.
    Session(const Instance& instance, const XrClock& clock, const vulkan::Context& context);
    Session(const Session&) = delete;
    Session& operator=(const Session&) = delete;
    ~Session();

    /// Whether frames are wanted.
    enum class Activity {
        Running,
        Idle,   ///< not now
        Ended,  ///< never again
    };

    /// Handles what the runtime has to say; waits a few milliseconds while it wants nothing.
    /// Throws SetupError (SessionLost) when session or instance is going away.
    Activity poll();

    /// Asks the runtime to end; poll() then ends in Ended.
    void request_exit();

    [[nodiscard]] XrSession handle() const { return session_; }
    [[nodiscard]] const Instance& instance() const { return instance_; }
    [[nodiscard]] const XrClock& clock() const { return clock_; }
    [[nodiscard]] XrSpace local_space() const { return local_space_; }
    [[nodiscard]] XrSpace view_space() const { return view_space_; }
    /// The state that the runtime announced last.
    [[nodiscard]] XrSessionState state() const { return state_; }

    /// How often the runtime said that another interaction profile is bound.
    [[nodiscard]] std::uint64_t profile_changes() const { return profile_changes_; }
    /// How often the runtime said that the visibility mask is another.
    [[nodiscard]] std::uint64_t mask_changes() const { return mask_changes_; }

    /// What the runtime has said since the last call of LOCAL space's origin, which it moves.
    [[nodiscard]] std::vector<gaze::AnnouncedOrigin> take_new_origins() {
        return std::exchange(new_origins_, {});
    }

    /// The head in LOCAL space. None where the runtime does not know it (too long ago, not tracked)
    /// or gives what is no pose. Throws SetupError (SessionLost).
    [[nodiscard]] std::optional<gaze::Pose> head_at(XrTime time) const;

    // A session's action sets are attached once, all together, and synchronized together: those
    // that a call leaves out are inactive until the next one.

    /// Precondition: attach_actions() has not been called. The set must outlive the session's
    /// frames.
    void add_actions(XrActionSet set) { action_sets_.push_back({set, XR_NULL_PATH}); }
    /// Attaches those that were added, once; does nothing without any, or the second time. Throws
    /// SetupError.
    void attach_actions();
    /// Takes over the newest state of all their actions; false: the session does not have the
    /// focus. Precondition: they are attached. Throws SetupError (SessionLost).
    [[nodiscard]] bool sync_actions() const;

    /// Adds one line for take_events().
    void tell(const frame::EventKind& kind, std::string text);
    /// What happened since the last call.
    [[nodiscard]] std::vector<frame::Event> take_events() { return std::exchange(events_, {}); }

  private:
    void handle_event(const XrEventDataBuffer& event);
    void change_state(const XrEventDataSessionStateChanged& changed);
    void begin();
    void end();
    void move_origin(const XrEventDataReferenceSpaceChangePending& pending);

    const Instance& instance_;
    const XrClock& clock_;
    XrSession session_;
    XrSpace local_space_;
    XrSpace view_space_;
    XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
    std::uint64_t profile_changes_ = 0;
    std::uint64_t mask_changes_ = 0;
    std::vector<gaze::AnnouncedOrigin> new_origins_;
    std::vector<frame::Event> events_;
    std::vector<XrActiveActionSet> action_sets_;
    bool actions_attached_ = false;
    bool running_ = false;
    bool exit_requested_ = false;
    bool exit_sent_ = false;
    bool ended_ = false;
    std::chrono::steady_clock::time_point exit_deadline_;
    int idle_polls_ = 0;
};

}  // namespace gazeloop::openxr
