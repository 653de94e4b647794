#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "runtime/gaze/pose.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::sim {

/// Where a head points: yaw positive to the left, pitch positive up (turns about +Y and +X).
struct Heading {
    double yaw_rad = 0.0;
    double pitch_rad = 0.0;

    friend Heading operator+(const Heading& a, const Heading& b) {
        return {a.yaw_rad + b.yaw_rad, a.pitch_rad + b.pitch_rad};
    }
};

[[nodiscard]] glm::dquat orientation(const Heading& heading);

/// A head that sways all the time (sums of sines between .1 and 1.5 Hz with amplitudes as one over
/// their frequency) and turns when it is told to. Each turn has a minimum-jerk course whose peak
/// velocity is a fixed multiple of its amplitude; turns that overlap add up.
class SimulatedHead {
  public:
    SimulatedHead(const HeadTerms& terms, std::uint64_t seed);

    void make_room_for_turns(std::size_t turns) { turns_.reserve(turns); }

    /// Turns by this much more, from `begin_s` on; not before the turn added last.
    void turn(double begin_s, const Heading& by);

    /// The pose at a time >= 0 s: at the origin, while it does not move.
    [[nodiscard]] gaze::Pose at(double time_s) const;

    /// What sway and turns add to the heading at a time; and what the turns add when all are over.
    [[nodiscard]] Heading swayed(double time_s) const;
    [[nodiscard]] Heading turned(double time_s) const;
    [[nodiscard]] Heading rest() const { return rest_; }

  private:
    struct Sine {
        double amplitude_rad = 0.0;
        double angular_hz = 0.0;  ///< radians per second
        double phase_rad = 0.0;
    };
    using Sway = std::array<Sine, 3>;
    struct Turn {
        double begin_s;
        Heading before;  ///< sum of all turns ahead of it
        Heading by;
    };

    [[nodiscard]] static double sum(const Sway& sway, double time_s);

    HeadTerms terms_;
    double turn_s_;
    Sway yaw_;
    Sway pitch_;
    std::vector<Turn> turns_;
    Heading rest_;
};

}  // namespace gazeloop::sim
