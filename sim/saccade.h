#pragma once

#include <glm/vec3.hpp>

#include "runtime/gaze/main_sequence.h"

namespace gazeloop::sim {

/// A rapid turn of the gaze from one direction to another, along the great circle, as fast as the
/// main sequence has it (runtime/gaze/main_sequence.h).
class Saccade {
  public:
    /// No turn, of duration 0. Unit vector.
    explicit Saccade(const glm::dvec3& resting);

    /// Unit vectors that differ. `vigour` > 0 makes it so many times as fast as the main sequence.
    Saccade(const glm::dvec3& from, const glm::dvec3& to, double vigour);

    [[nodiscard]] double duration_s() const { return course_.duration_s(); }
    [[nodiscard]] const glm::dvec3& to() const { return to_; }

    /// The share of the way that is done, 0 .. 1; `elapsed_s` >= 0.
    [[nodiscard]] double progress(double elapsed_s) const { return course_.progress(elapsed_s); }
    [[nodiscard]] glm::dvec3 at(double elapsed_s) const;

  private:
    glm::dvec3 from_;
    glm::dvec3 to_;
    glm::dvec3 axis_{0.0, 1.0, 0.0};
    double amplitude_rad_ = 0.0;
    gaze::SaccadeCourse course_;
};

}  // namespace gazeloop::sim
