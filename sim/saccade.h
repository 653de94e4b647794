#pragma once

#include <glm/vec3.hpp>

namespace gazeloop::sim {

/// How long a saccade takes and how fast it gets.
struct MainSequence {
    double duration_s;
    double peak_deg_per_s;
};

/// The main sequence: peak velocity 596 (1 - exp(-A / 6.47)) deg/s and duration 2.54 A + 15.9 ms
/// for an amplitude of A degrees. It is fitted to the 543 saccades up to 23 deg that coders
/// labelled in the recordings of Andersson et al. 2017 (Behavior Research Methods 49:616).
/// Amplitude > 0.
[[nodiscard]] MainSequence main_sequence(double amplitude_deg);

/// A rapid turn of the gaze from one direction to another, along the great circle. Its velocity is
/// symmetrical and smooth, zero at both ends, and has the peak and the duration of the main
/// sequence (large real saccades lean to an early peak).
class Saccade {
  public:
    /// No turn, of duration 0. Unit vector.
    explicit Saccade(const glm::dvec3& resting);

    /// Unit vectors that differ. `vigour` > 0 makes it so many times as fast as the main sequence.
    Saccade(const glm::dvec3& from, const glm::dvec3& to, double vigour);

    [[nodiscard]] double duration_s() const { return duration_s_; }
    [[nodiscard]] const glm::dvec3& to() const { return to_; }

    /// The share of the way that is done, 0 .. 1; `elapsed_s` >= 0.
    [[nodiscard]] double progress(double elapsed_s) const;
    [[nodiscard]] glm::dvec3 at(double elapsed_s) const;

  private:
    glm::dvec3 from_;
    glm::dvec3 to_;
    glm::dvec3 axis_{0.0, 1.0, 0.0};
    double amplitude_rad_ = 0.0;
    double duration_s_ = 0.0;
    double sharpness_ = 0.0;
};

}  // namespace gazeloop::sim
