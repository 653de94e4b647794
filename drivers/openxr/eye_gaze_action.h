#pragma once

#include "drivers/openxr/gaze_gates.h"
#include "runtime/openxr/xr_check.h"

namespace gazeloop::drivers {

/// Sets the gates that need no session: whether the runtime lists XR_EXT_eye_gaze_interaction (the
/// caller knows) and, if so, whether the system supports it. True if both are open. Precondition:
/// the instance has the extension where it is listed.
bool check_instance_gates(XrInstance instance, XrSystemId system, bool listed, GazeGates& gates);

/// The action whose pose is the gaze, with its binding suggested to the runtime.
class EyeGazeAction {
  public:
    /// Precondition: the instance has XR_EXT_eye_gaze_interaction; it must outlive this. Throws
    /// SetupError (NoDevice).
    explicit EyeGazeAction(XrInstance instance);
    EyeGazeAction(const EyeGazeAction&) = delete;
    EyeGazeAction& operator=(const EyeGazeAction&) = delete;
    ~EyeGazeAction();

    /// What the runtime said of the suggested binding.
    [[nodiscard]] XrResult suggested() const { return suggested_; }

    [[nodiscard]] XrActionSet set() const { return set_; }
    [[nodiscard]] XrAction action() const { return action_; }
    /// /user/eyes_ext
    [[nodiscard]] XrPath user() const { return user_; }
    /// /interaction_profiles/ext/eye_gaze_interaction
    [[nodiscard]] XrPath profile() const { return profile_; }

  private:
    XrActionSet set_ = XR_NULL_HANDLE;
    XrAction action_ = XR_NULL_HANDLE;
    XrPath user_ = XR_NULL_PATH;
    XrPath profile_ = XR_NULL_PATH;
    XrResult suggested_ = XR_SUCCESS;
};

}  // namespace gazeloop::drivers
