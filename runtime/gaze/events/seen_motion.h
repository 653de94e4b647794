#pragma once

#include "runtime/gaze/events/eye_event.h"

namespace gazeloop::gaze {

/// What is seen of the eyes' movement at the newest sample, as far as it says how sure it is where
/// they look a little later.
struct SeenMotion {
    EyeEvent event = EyeEvent::Lost;
    double since_s = 0.0;  ///< for so long that goes on; 0 or more
    /// How far the newest direction lies from where the two before it were, in standard deviations
    /// of the resting gaze; 0 where less is seen. A saccade shows here a sample or two before it is
    /// one for certain.
    double departure = 0.0;
    /// A saccade goes on for at least so long, by its forecast less two standard deviations; 0 of
    /// all else.
    double flies_on_s = 0.0;
};

}  // namespace gazeloop::gaze
