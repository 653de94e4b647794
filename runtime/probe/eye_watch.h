#pragma once

#include "runtime/gaze/fovea_point.h"
#include "runtime/gaze/gaze_sample.h"
#include "runtime/probe/flip.h"

namespace gazeloop::probe {

/// Sees, frame by frame, whether an eye is lost that the tracker had before: by the frame's own
/// foveae, so that the patch follows the very gaze that the frame is drawn by. An eye that was
/// never tracked is not watched: a tracker may have one alone. Pure.
class EyeWatch {
  public:
    /// Of the settings (gaze.minimum_confidence).
    explicit EyeWatch(double minimum_confidence) : minimum_confidence_(minimum_confidence) {}

    void add(const gaze::GazeSample& sample);
    /// Takes a frame's foveae. Whether the answer of lost() is another than before.
    bool turns_at(const gaze::FrameFovea& fovea);

    [[nodiscard]] bool lost() const { return lost_; }
    /// What is known of the last turn before the frame is shown: state, reason, and the first
    /// sample that said so, if one did.
    [[nodiscard]] Flip turn() const;

  private:
    struct Eye {
        bool watched = false;
        bool usable = false;  ///< in the newest sample; false again where samples stay away
        Flip since{};         ///< the first sample of that kind, if one was
        gaze::LossReason reason = gaze::LossReason::None;
    };

    [[nodiscard]] const Eye& turned() const;

    double minimum_confidence_;
    gaze::PerEye<Eye> eyes_;
    bool lost_ = false;
};

}  // namespace gazeloop::probe
