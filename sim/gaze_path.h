#pragma once

#include <cstdint>
#include <vector>

#include "sim/gaze_simulation.h"
#include "sim/random.h"
#include "sim/saccade.h"
#include "sim/simulated_head.h"

namespace gazeloop::sim {

/// What the gaze does, seen in world.
enum class Movement : std::uint8_t { Fixation, Saccade, Pursuit };

/// Where the gaze goes in world: saccade, fixation, saccade ... beginning in a fixation at 0 s.
///
/// - Targets lie about the direction that the head will point in (normal, SD saccade_deg).
/// - A gaze shift may take the head along (turn_percent). Eye and head begin together; the eye
///   arrives first, and counter-rotates while the head follows. The new heading lies within 30 deg
///   of where the head points, so that no eye turns farther than about 50 deg.
/// - Fixations have log-normal durations (the logarithm's SD is .6, as in the recordings that
///   main_sequence was fitted to) and hold a point in world; with a vor_gain below 1 they slip.
/// - Distances change with the saccade, linearly in dioptres (real vergence is slower).
///
/// It keeps every movement, about 150 bytes each: less than 2 MB per hour.
class GazePath {
  public:
    GazePath(const EyeTerms& terms, const HeadTerms& head_terms, std::uint64_t seed,
             SimulatedHead& head);

    /// Plans up to a time; to be called before anything is asked about that time, or about the head
    /// at it.
    void plan_until(double time_s);

    struct Point {
        glm::dvec3 direction;  ///< unit, in world, from the head's origin
        double distance_m;
        Movement movement;
    };
    /// At a time >= 0 s that was planned.
    [[nodiscard]] Point at(double time_s) const;

  private:
    /// A saccade and what follows it.
    struct Shift {
        double begin_s = 0.0;
        Saccade saccade;
        double end_s = 0.0;
        double from_dioptres = 0.0;
        double to_dioptres = 0.0;
        double pursuit_rad_per_s = 0.0;  ///< 0: a fixation
        glm::dvec3 pursuit_axis{0.0, 1.0, 0.0};

        [[nodiscard]] double landing_s() const { return begin_s + saccade.duration_s(); }
    };

    [[nodiscard]] const Shift& shift_at(double time_s) const;
    [[nodiscard]] glm::dvec3 direction(const Shift& shift, double time_s) const;
    void add_shift();
    void turn_head(std::uint64_t event, double begin_s);
    [[nodiscard]] glm::dvec3 target(Random& random, const Heading& about) const;
    void plan_stay(Shift& shift, std::uint64_t event) const;
    [[nodiscard]] double draw_dioptres(std::uint64_t event) const;

    EyeTerms terms_;
    HeadTerms head_terms_;
    std::uint64_t seed_;
    SimulatedHead& head_;
    std::vector<Shift> shifts_;
};

}  // namespace gazeloop::sim
