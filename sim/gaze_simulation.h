#pragma once

#include <cstdint>
#include <string_view>
#include <vector>

namespace gazeloop::sim {

/// What the eyes do. A term that is 0 is off: it draws no random number and costs nothing.
struct EyeTerms {
    /// SD of the gaze targets' horizontal distance from where the head points, degrees (vertical:
    /// two thirds of it); no target lies farther than twice this. 0: the gaze never leaves its
    /// first target, hence no saccade, pursuit or head turn either.
    double saccade_deg = 9.0;
    double saccade_scatter_percent = 15.0;  ///< SD of peak velocities about the main sequence
    double fixation_ms = 224.0;             ///< median duration
    double drift_deg = 0.15;                ///< SD of the drift within a median fixation
    double microsaccades_per_s = 1.5;
    double pursuit_percent = 0.0;     ///< of the fixations: something that moves is followed
    double pursuit_deg_per_s = 10.0;  ///< its speed
    double blinks_per_min = 15.0;
    double distance_m = 1.5;       ///< median distance of what is looked at, from the head's origin
    double distance_spread = 0.0;  ///< SD of that distance's natural logarithm
    double ipd_mm = 63.0;          ///< between the eyes
};

/// What the head does. With sway and turns both off it stands still and no head pose is known.
struct HeadTerms {
    double sway_deg = 1.5;          ///< RMS of its continuous motion in yaw; in pitch half as much
    double turn_percent = 25.0;     ///< of the gaze shifts: the head takes part
    double turn_deg = 12.0;         ///< SD of the headings it turns to, yaw; pitch a third of it
    double turn_speed_per_s = 4.0;  ///< peak velocity of a turn over its amplitude
    double pivot_m = 0.1;           ///< it turns about a point so far behind the eyes
    double vor_gain = 1.0;  ///< 1: eyes in fixation counter-rotate fully to turns; 0: not at all.
                            /// < Eyes always follow the shift by the pivot

    [[nodiscard]] bool moves() const { return sway_deg > 0.0 || turn_percent > 0.0; }
};

/// What the tracker makes of it. All off: every sample is true and arrives when it is taken.
struct TrackerTerms {
    double rate_hz = 120.0;
    double delay_ms = 0.0;   ///< from the sample to its arrival
    double jitter_ms = 0.0;  ///< mean of an exponential delay on top; samples never overtake
    double bias_deg = 0.0;   ///< accuracy: median over seeds of an eye's constant error
    double bias_growth_percent = 0.0;   ///< of that error for each degree from straight ahead
    double noise_deg = 0.0;             ///< precision: SD on each of two axes, white
    double noise_growth_percent = 0.0;  ///< of the noise for each degree from straight ahead
    double quantum_deg = 0.0;           ///< directions come in steps of this, on both axes
    double dropout_percent = 0.0;       ///< of the samples: they never arrive
    double eye_loss_percent = 0.0;      ///< of an eye's samples: the tracker has lost this eye
    double dropout_ms = 0.0;            ///< mean length of such a gap; at least one sample
    double clock_ppm = 0.0;             ///< its clock gains this on the host's
};

/// A person with a tracker. The same values give the same samples, bit for bit, on one machine
/// (and wherever the C library's sin, cos, exp and log agree).
struct GazeSimulation {
    std::uint64_t seed = 1;
    EyeTerms eye{};
    HeadTerms head{};
    TrackerTerms tracker{};
};

/// One term under its name, with its range.
struct Term {
    std::string_view key;  ///< e.g. "noise_deg", "head.sway_deg"
    std::string_view meaning;
    double* value;
    double least;
    double greatest;
    bool of_tracker;  ///< a tracker profile may state it
};

/// Every term of a simulation, by key. The values point into it.
std::vector<Term> terms_of(GazeSimulation& simulation);

}  // namespace gazeloop::sim
