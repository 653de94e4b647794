#pragma once

#include <vector>

#include "runtime/gaze/gaze_to_fovea.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::tests {

/// One eye in one frame: how far from its fovea it truly looked when the frame was shown.
struct ShownGaze {
    double error_deg = 0.0;     ///< of the fovea
    double widening_deg = 0.0;  ///< FoveaPoint::uncertainty_rad; 0 where it is none
    bool in_flight = false;     ///< a saccade is under way: the eye sees little
    bool covered = false;       ///< the lids cover the pupil: it sees nothing
};

/// What is shown: pictures of these views (with the head at the origin), each read at a multiple of
/// the period and shown one period later, as virtual time has it.
struct Headset {
    gaze::StereoView views;
    double refresh_hz = 90.0;
};

/// A person's first `seconds` in the headset, without the first two: both eyes of every frame.
[[nodiscard]] std::vector<ShownGaze> shown_gaze(const sim::GazeSimulation& person,
                                                const Headset& headset,
                                                const gaze::FoveaPolicy& policy, double seconds);

}  // namespace gazeloop::tests
