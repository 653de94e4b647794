#pragma once

#include "drivers/gaze_source.h"
#include "drivers/openxr/eye_gaze_space.h"
#include "drivers/openxr/gaze_reader.h"

namespace gazeloop::drivers {

/// What an instance must have enabled for OpenXrSource, where the runtime offers it.
inline constexpr const char* kEyeGazeExtension = XR_EXT_EYE_GAZE_INTERACTION_EXTENSION_NAME;

struct OpenXrGazeOptions {
    double distance_m = 1.5;  ///< where the eyes' rays meet, see gaze::eye_rays
    /// Let the rays meet where the depth given to take_seen_depth() says, if it does:
    /// find_fixation() of gaze/fixation.h.
    bool from_depth = false;
};

/// The eye gaze of an OpenXR runtime (XR_EXT_eye_gaze_interaction): one ray for both eyes. It is
/// read when it is asked for, at the latch, because the runtime itself keeps it up to date.
class OpenXrSource final : public GazeSource {
  public:
    /// `session` must outlive this; no action sets can be added to it later. Throws SetupError
    /// (NoDevice) where the runtime or the headset has no eye gaze, naming the gate and what opens
    /// it.
    OpenXrSource(openxr::Session& session, const OpenXrGazeOptions& options);

    /// Throws SetupError (SessionLost) when the runtime is gone.
    void poll(std::int64_t now_ns, std::vector<gaze::GazeSample>& samples) override;
    void take_seen_depth(const gaze::SeenDepth& seen) override;
    [[nodiscard]] std::vector<SourceEvent> take_events() override { return gates_.take_events(); }
    [[nodiscard]] std::string description() const override;

    [[nodiscard]] const GazeGates& gates() const { return gates_; }

  private:
    [[noreturn]] void refuse() const;
    [[nodiscard]] GazeAnswer ask(std::int64_t now_ns);

    const openxr::Session& session_;
    OpenXrGazeOptions options_;
    gaze::SeenDepth seen_;
    GazeGates gates_;
    GazeReader reader_;
    std::optional<EyeGazeAction> action_;
    std::optional<EyeGazeSpace> space_;
    std::uint64_t profile_changes_ = 0;
    bool bound_ = false;
};

}  // namespace gazeloop::drivers
