#pragma once

#include <optional>

#include "drivers/openxr/eye_gaze_action.h"
#include "runtime/openxr/session.h"

namespace gazeloop::drivers {

/// A gaze pose as the runtime gives it.
struct LocatedGaze {
    std::optional<gaze::Pose> pose;  ///< in VIEW space; none where it is not valid, or is no pose
    bool valid = false;              ///< what the runtime says of it
    bool tracked = false;            ///< false: "sub-nominal", not to be relied on
    XrTime time = 0;                 ///< XrEyeGazeSampleTimeEXT
};

/// The gaze in a session.
class EyeGazeSpace {
  public:
    /// Attaches the action to the session, with those that were added before; no others can be
    /// later. Both must outlive this. Throws SetupError.
    EyeGazeSpace(openxr::Session& session, const EyeGazeAction& action);
    EyeGazeSpace(const EyeGazeSpace&) = delete;
    EyeGazeSpace& operator=(const EyeGazeSpace&) = delete;
    ~EyeGazeSpace();

    // Each throws SetupError (SessionLost) when the runtime refuses or is gone.

    /// Takes over the newest state of the action; false: the session does not have the focus.
    [[nodiscard]] bool sync() const;
    /// The interaction profile that the runtime has bound to the eyes; XR_NULL_PATH: none.
    [[nodiscard]] XrPath bound_profile() const;
    [[nodiscard]] bool active() const;
    /// None where the runtime has no pose for that time, whether or not it sees the eyes.
    [[nodiscard]] std::optional<LocatedGaze> locate(XrTime time) const;
    /// Where the eyes are in VIEW space; none where the runtime does not know.
    [[nodiscard]] std::optional<gaze::PerEye<glm::dvec3>> eyes_m(XrTime time) const;

  private:
    const openxr::Session& session_;
    const EyeGazeAction& action_;
    XrSpace space_ = XR_NULL_HANDLE;
};

}  // namespace gazeloop::drivers
