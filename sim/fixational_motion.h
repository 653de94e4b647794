#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "sim/gaze_simulation.h"

namespace gazeloop::sim {

/// What an eye adds to the direction it holds.
struct FixationalOffset {
    double right_rad = 0.0;
    double up_rad = 0.0;
    bool microsaccade = false;  ///< one is under way
};

/// The small movements on top of fixation: drift and microsaccades (tremor, below an arc minute, is
/// left out). Both eyes make them together. They go on during saccades, where nobody can see them.
///
/// - Drift: per axis three sines between .8 and 4.8 Hz, with amplitudes as one over their
///   frequency. They are scaled so that drift_deg is the expected SD about the mean within a window
///   of 224 ms, both axes together.
/// - Microsaccades: a Poisson process; amplitudes of .1 to 1 deg (uniform in the logarithm), on the
///   main sequence. Each goes back towards the centre, within 60 deg of that direction.
class FixationalMotion {
  public:
    FixationalMotion(const EyeTerms& terms, std::uint64_t seed);

    /// Plans up to a time, before anything is asked about it.
    void plan_until(double time_s);

    /// At a time >= 0 s that was planned.
    [[nodiscard]] FixationalOffset at(double time_s) const;

  private:
    struct Sine {
        double amplitude_rad = 0.0;
        double angular_hz = 0.0;  ///< radians per second
        double phase_rad = 0.0;
    };
    using Drift = std::array<Sine, 3>;
    struct Offset {
        double right_deg = 0.0;
        double up_deg = 0.0;
    };
    struct Microsaccade {
        double begin_s = 0.0;
        double duration_s = 0.0;
        Offset from;
        Offset to;
    };

    [[nodiscard]] static double sum(const Drift& drift, double time_s);
    void add_microsaccade();

    EyeTerms terms_;
    std::uint64_t seed_;
    Drift right_;
    Drift up_;
    std::vector<Microsaccade> microsaccades_;
};

}  // namespace gazeloop::sim
