#pragma once

namespace gazeloop::gaze {

/// A saccade that is going on, as seen so far.
struct SaccadeInFlight {
    double travelled_deg = 0.0;  ///< from where it began; 0 or more
    double elapsed_s = 0.0;      ///< since it was noticed
    double speed_deg_per_s = 0.0;
    double peak_deg_per_s = 0.0;  ///< the greatest speed so far; at least speed_deg_per_s
    double speed_age_s = 0.0;     ///< how long ago the speed was that: half its window
    /// Of the person: how fast their saccades are, 1 as usual.
    double vigour = 1.0;
};

/// How far it will have travelled on.
struct SaccadeTravel {
    double further_deg = 0.0;  ///< from now; 0 or more
    double sd_deg = 0.0;       ///< standard deviation of that
};

/// Saccades of all amplitudes and of three vigours on the main sequence (main_sequence.h), each
/// weighed by how well it explains what was seen, are the forecast: their mean and deviation.
/// `ahead_s` >= 0. Further travel of 0 where nothing explains it.
[[nodiscard]] SaccadeTravel forecast(const SaccadeInFlight& seen, double ahead_s);

}  // namespace gazeloop::gaze
