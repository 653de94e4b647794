#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <optional>

namespace gazeloop::gaze {

/// How near the point is at which both eyes are assumed to look, followed from sample to sample of
/// a combined gaze. Unit 1/m; 0: infinitely far. Pure.
///
/// Eyes do not change their vergence within a frame: that begins some 160 ms after its cause and
/// takes several hundred more (Rashbass & Westheimer 1961). So in one fixation the nearness follows
/// with a time constant. Else, beside an edge, the tracker's noise would throw each eye's fovea
/// between near and far, several degrees, with every sample. Where the gaze jumps, nothing is
/// followed. What was looked at before says nothing of what is looked at now, and the eyes see
/// little until the jump ends.
class Vergence {
  public:
    /// How fast it follows in one fixation.
    static constexpr double kTimeConstant_s = 0.08;
    /// More than this between two samples is a jump: 3 degrees, more than trackers' noise and a
    /// held gaze move.
    static constexpr double kJump_rad = 0.0524;
    static constexpr std::int64_t kGap_ns = 200'000'000;  ///< so is a longer gap

    /// For a sample that arrives at `now_ns` and looks along `direction`, a unit vector in the
    /// head. `found` is the nearness that the scene says; none: unknown, and `assumed` counts.
    double follow(std::optional<double> found, double assumed, const glm::dvec3& direction,
                  std::int64_t now_ns);

    /// The next sample begins a fixation.
    void forget() { last_.reset(); }

  private:
    struct Last {
        glm::dvec3 direction;
        std::int64_t now_ns;
        double nearness;
        bool found;  ///< in this fixation; the first one found counts at once
    };
    std::optional<Last> last_;
};

}  // namespace gazeloop::gaze
