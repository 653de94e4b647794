#pragma once

#include <cstdint>

#include "runtime/gaze/gaze_sample.h"
#include "sim/blinks.h"
#include "sim/fixational_motion.h"
#include "sim/gaze_path.h"
#include "sim/gaze_simulation.h"
#include "sim/simulated_head.h"

namespace gazeloop::sim {

/// What the eyes truly do at one time, without any tracker.
struct TrueGaze {
    /// In the head frame: both directions meet at the target. Openness is the lids'; valid always.
    gaze::PerEye<gaze::EyeRay> eyes;
    gaze::Pose head;         ///< in world
    glm::dvec3 target_m{0};  ///< what is looked at, in world
    Movement movement = Movement::Fixation;
    bool microsaccade = false;
};

/// Somebody who looks around: the ground truth that a tracker's samples are judged by. Times are
/// seconds from the start, >= 0, and may be asked in any order; the same time gives the same
/// answer. Asking for a later time than ever before plans up to it, which takes memory and time in
/// proportion (GazePath).
class Person {
  public:
    Person(const EyeTerms& eye, const HeadTerms& head, std::uint64_t seed);
    Person(const Person&) = delete;
    Person& operator=(const Person&) = delete;
    ~Person() = default;

    [[nodiscard]] TrueGaze at(double time_s);
    [[nodiscard]] gaze::Pose head_at(double time_s);
    [[nodiscard]] bool head_moves() const { return head_moves_; }

  private:
    bool head_moves_;
    gaze::PerEye<double> eye_x_m_;
    SimulatedHead head_;
    GazePath path_;
    FixationalMotion fixational_;
    Blinks blinks_;
};

}  // namespace gazeloop::sim
