#include "sim/gaze_simulation.h"

namespace gazeloop::sim {

std::vector<Term> terms_of(GazeSimulation& simulation) {
    EyeTerms& eye = simulation.eye;
    HeadTerms& head = simulation.head;
    TrackerTerms& tracker = simulation.tracker;
    return {
        {"bias_deg", "median of an eye's constant error, deg", &tracker.bias_deg, 0, 90, true},
        {"bias_growth_percent", "growth of that error per degree off axis, %",
         &tracker.bias_growth_percent, 0, 100, true},
        {"blinks_per_min", "blinks per minute", &eye.blinks_per_min, 0, 60, false},
        {"clock_ppm", "how much too fast the tracker's clock runs, parts per million",
         &tracker.clock_ppm, -1000, 1000, true},
        {"delay_ms", "delay from sample to arrival, ms", &tracker.delay_ms, 0, 1000, true},
        {"distance_m", "median distance of what is looked at, m", &eye.distance_m, 0.15, 1000,
         false},
        {"distance_spread", "SD of the logarithm of that distance", &eye.distance_spread, 0, 2,
         false},
        {"drift_deg", "SD of the drift in a median fixation, deg", &eye.drift_deg, 0, 5, false},
        {"dropout_ms", "mean length of a gap, ms; at least one sample", &tracker.dropout_ms, 0,
         10000, true},
        {"dropout_percent", "samples that never arrive, %", &tracker.dropout_percent, 0, 100, true},
        {"eye_loss_percent", "samples in which an eye is lost, %", &tracker.eye_loss_percent, 0,
         100, true},
        {"fixation_ms", "median duration of a fixation, ms", &eye.fixation_ms, 20, 60000, false},
        {"head.pivot_m", "distance behind the eyes of the point that the head turns about, m",
         &head.pivot_m, 0, 0.5, false},
        {"head.sway_deg", "RMS of the head's continuous motion, deg", &head.sway_deg, 0, 30, false},
        {"head.turn_deg", "SD of the headings that the head turns to, deg", &head.turn_deg, 0, 60,
         false},
        {"head.turn_percent", "gaze shifts in which the head takes part, %", &head.turn_percent, 0,
         100, false},
        {"head.turn_speed_per_s", "peak velocity of a turn / its amplitude, 1/s",
         &head.turn_speed_per_s, 0.5, 20, false},
        {"head.vor_gain", "counter-rotation of the eyes in head turns; 1: full", &head.vor_gain, 0,
         1, false},
        {"ipd_mm", "distance between the eyes, mm", &eye.ipd_mm, 0, 200, false},
        {"jitter_ms", "mean of a further delay, exponentially distributed, ms", &tracker.jitter_ms,
         0, 100, true},
        {"microsaccades_per_s", "microsaccades per second", &eye.microsaccades_per_s, 0, 10, false},
        {"noise_deg", "SD of the noise on each axis, deg", &tracker.noise_deg, 0, 90, true},
        {"noise_growth_percent", "growth of the noise per degree off axis, %",
         &tracker.noise_growth_percent, 0, 100, true},
        {"pursuit_deg_per_s", "speed of what is followed, deg/s", &eye.pursuit_deg_per_s, 0, 100,
         false},
        {"pursuit_percent", "fixations that follow something, %", &eye.pursuit_percent, 0, 100,
         false},
        {"quantum_deg", "step in which directions are reported, deg", &tracker.quantum_deg, 0, 10,
         true},
        {"rate_hz", "samples per second, Hz", &tracker.rate_hz, 1, 10000, true},
        {"saccade_deg", "SD of gaze targets about the head's direction, deg; 0: no saccades",
         &eye.saccade_deg, 0, 30, false},
        {"saccade_scatter_percent", "SD of peak velocities about the main sequence, %",
         &eye.saccade_scatter_percent, 0, 50, false},
    };
}

}  // namespace gazeloop::sim
