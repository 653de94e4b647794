#pragma once

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "runtime/openxr/xr_check.h"
#include "runtime/openxr_layer/gazeloop_gaze_sample.h"
#include "tests/support/run_program.h"

namespace gazeloop::tests {

/// This process as an application of OpenXR that knows nothing of gazeloop, on Monado without
/// pictures (XR_MND_headless), with the layer of this build switched on and a home of its own.
class LayeredHome {
  public:
    /// Settings of the layer, KEY=VALUE.
    explicit LayeredHome(const std::vector<std::string>& settings);

    [[nodiscard]] std::string file(const std::string& name) const { return folder_.file(name); }
    /// What the layer has logged.
    [[nodiscard]] std::string log() const;
    void write_config(const std::string& name, const std::string& text) const;

  private:
    ScratchFolder folder_;
};

/// One action of the application, bound to the eyes.
struct EyeAction {
    XrActionSet set = XR_NULL_HANDLE;
    XrAction action = XR_NULL_HANDLE;
};

/// Where a gaze was said to be.
struct SaidGaze {
    XrResult result = XR_SUCCESS;
    XrSpaceLocationFlags flags = 0;
    XrPosef pose{};
    XrSpaceVelocityFlags velocity_flags = 0;
    XrVector3f angular{};
    XrTime time = -1;
    XrGazeSampleGAZELOOP sample{};
};

/// An instance with all that an application does to read gaze. Failures of the runtime throw.
class LayeredApplication {
  public:
    /// `more`: extensions beside eye gaze, headless and the clock.
    explicit LayeredApplication(const std::vector<const char*>& more = {});
    LayeredApplication(const LayeredApplication&) = delete;
    LayeredApplication& operator=(const LayeredApplication&) = delete;
    ~LayeredApplication();

    [[nodiscard]] XrInstance instance() const { return instance_; }
    [[nodiscard]] XrSession session() const { return session_; }
    [[nodiscard]] XrPath path(const char* text) const;
    [[nodiscard]] bool supports_eye_gaze() const;
    [[nodiscard]] XrTime now() const;

    EyeAction make_action(const char* name, std::uint32_t priority = 0, bool for_eyes = false);
    XrResult suggest(const std::vector<XrAction>& actions,
                     const char* path = "/user/eyes_ext/input/gaze_ext/pose");
    /// Begins the session and waits until it has the focus.
    void begin(const std::vector<XrActionSet>& attached);
    XrSpace gaze_space(XrAction action, XrPath user = XR_NULL_PATH);
    XrSpace reference_space(XrReferenceSpaceType type);

    XrResult sync(const std::vector<XrActiveActionSet>& sets);
    [[nodiscard]] bool active(XrAction action, XrPath user = XR_NULL_PATH) const;
    [[nodiscard]] SaidGaze locate(XrSpace space, XrSpace base, XrTime time) const;
    /// Synchronizes for so long, so that samples come.
    void sync_for(const EyeAction& action, double seconds);

    /// Takes the events that are there: how many said that another profile is bound.
    std::size_t profile_changes();

  private:
    XrInstance instance_ = XR_NULL_HANDLE;
    XrSystemId system_ = XR_NULL_SYSTEM_ID;
    XrSession session_ = XR_NULL_HANDLE;
    XrSessionState state_ = XR_SESSION_STATE_UNKNOWN;
    std::size_t profile_changes_ = 0;
    PFN_xrConvertTimespecTimeToTimeKHR to_xr_time_ = nullptr;

    void take_events();
};

}  // namespace gazeloop::tests
