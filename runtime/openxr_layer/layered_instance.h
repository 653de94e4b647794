#pragma once

#include <deque>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <vector>

#include "runtime/openxr_layer/eye_bindings.h"
#include "runtime/openxr_layer/followed_foveae.h"
#include "runtime/openxr_layer/frame_tap.h"
#include "runtime/openxr_layer/gaze_feed.h"
#include "runtime/openxr_layer/layer_configuration.h"
#include "runtime/openxr_layer/next_functions.h"
#include "runtime/openxr_layer/permissions.h"
#include "runtime/openxr_layer/quad_views/quad_session.h"
#include "runtime/openxr_layer/sightings.h"
#include "runtime/openxr_layer/time_line.h"

namespace gazeloop::openxr_layer {

/// A space of the application's that follows the gaze.
struct GazeSpace {
    XrAction action = XR_NULL_HANDLE;
    bool eyes_alone = false;  ///< made for the eyes' path
    gaze::Pose pose_in_gaze;  ///< poseInActionSpace
};

/// How often an application was given something, in periods without a long pause.
class Reading {
  public:
    /// Whether a period begins with it.
    [[nodiscard]] bool note(std::int64_t now_ns) {
        constexpr std::int64_t kLongPause_ns = 10'000'000'000;
        const bool begins = times_++ == 0 || now_ns - last_ns_ > kLongPause_ns;
        last_ns_ = now_ns;
        return begins;
    }
    [[nodiscard]] std::uint64_t times() const { return times_; }

  private:
    std::uint64_t times_ = 0;
    std::int64_t last_ns_ = 0;
};

/// What the layer knows of a session.
struct LayeredSession {
    XrSession handle = XR_NULL_HANDLE;
    // The layer's own; null where the runtime gave none.
    XrSpace view_space = XR_NULL_HANDLE;
    XrSpace local_space = XR_NULL_HANDLE;
    std::shared_ptr<GazeFeed> feed;        ///< null: there is no gaze
    std::unique_ptr<FrameTap> tap;         ///< null: nothing is recorded
    std::optional<PictureSize> full;       ///< of recorded views, as the runtime recommends
    std::optional<FollowedFoveae> foveae;  ///< none: the application asked for no foveation
    std::shared_ptr<QuadSession> quad;     ///< null: it cannot have four views
    std::optional<XrTime> display;         ///< of the frame that was waited for last
    std::vector<XrActionSet> attached;
    bool profile_told = false;      ///< that the eye gaze profile is bound
    std::vector<XrAction> active;   ///< driven by the eyes since the last xrSyncActions
    std::vector<SyncedSet> synced;  ///< of the last xrSyncActions
    std::map<XrSpace, GazeSpace> gaze_spaces;
    std::vector<XrSpace> view_spaces;   ///< the application's own that are fixed to the head
    XrSpace views_in = XR_NULL_HANDLE;  ///< the space that the recorded views are in
    Reading gaze_read;
    Reading foveation_read;
    std::set<XrFoveationProfileFB> foveation_profiles;
    /// The profile of each of the application's swapchains; null: none was applied.
    std::map<XrSwapchain, XrFoveationProfileFB> foveation;
};

/// What the layer gives an instance because the runtime has it not, and the application asked.
struct OwnExtensions {
    bool foveation_profiles = false;  ///< XR_FB_foveation
    bool swapchain_state = false;     ///< XR_FB_swapchain_update_state
    bool foveation_state = false;     ///< XR_META_foveation_eye_tracked
    bool quad_views = false;          ///< XR_VARJO_quad_views, or what OpenXR 1.1 made of it

    [[nodiscard]] bool any() const {
        return foveation_profiles || swapchain_state || foveation_state || quad_views;
    }
};

/// Who provides XR_EXT_eye_gaze_interaction to an instance that has enabled it.
enum class EyeGazeBy : std::uint8_t {
    Nobody,   ///< the application has not enabled it
    Runtime,  ///< the layer keeps out of it
    Layer,
};

/// What the layer knows of an instance. Whoever reads or changes what is below `mutex` holds it;
/// the rest stays as it was made.
struct LayeredInstance {
    XrInstance handle = XR_NULL_HANDLE;
    PFN_xrGetInstanceProcAddr next_proc = nullptr;
    NextFunctions next;
    bool passes_through = false;  ///< nothing is hooked: the layer could not work
    LayerConfiguration configuration;
    std::string application;
    std::string runtime;
    EyeGazeBy eye_gaze = EyeGazeBy::Nobody;
    bool tells_samples = false;  ///< XR_GAZELOOP_gaze_sample is enabled
    /// XR_KHR_convert_timespec_time is enabled for the layer, and the application has not asked.
    bool hides_times = false;
    OwnExtensions owns;
    InsetPolicy inset_policy;
    XrPath eyes = XR_NULL_PATH;  ///< /user/eyes_ext
    XrPath gaze_pose = XR_NULL_PATH;
    XrPath profile = XR_NULL_PATH;
    std::shared_ptr<GazeFeed> feed;  ///< null: there is no gaze

    std::mutex mutex;
    TimeLine times;
    std::optional<GazePermission> permission;
    EyeBindings bindings;
    std::map<XrSession, LayeredSession> sessions;
    std::deque<XrEventDataBuffer> events;  ///< of the layer, to be polled before the runtime's
    Sighting sighting;
    std::uint64_t made_handles = 0;  ///< of the layer's own objects

    /// Null: it is none of this instance's.
    [[nodiscard]] LayeredSession* session(XrSession session) {
        const auto found = sessions.find(session);
        return found != sessions.end() ? &found->second : nullptr;
    }
    [[nodiscard]] bool provides_eye_gaze() const { return eye_gaze == EyeGazeBy::Layer; }

    /// Whether the application may have gaze now; tells of what changes. Under `mutex`.
    [[nodiscard]] bool permits_gaze();
    /// Whether its pictures may follow the gaze: who may have gaze may have that too.
    [[nodiscard]] bool permits_foveation();
    /// The application was given gaze: each time that it begins to read is told. Under `mutex`.
    void note_gaze_read(LayeredSession& session, std::int64_t now_ns);
    /// It was given where its pictures are to be fine. Under `mutex`.
    void note_foveation_read(LayeredSession& session);
    /// A session is over: how often it was given gaze is told, and its recording ends. Under
    /// `mutex`.
    void end_session(XrSession session);
    void end_sessions();
    /// The program ends and has not destroyed the instance: what is recorded is closed, and the
    /// layer's threads end. Whoever is in a call may go on.
    void end_without_the_application();

  private:
    [[nodiscard]] std::optional<GazePermission::Verdict> verdict();
};

}  // namespace gazeloop::openxr_layer
