#pragma once

namespace gazeloop::gaze {

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

/// How a saccade goes its way. Its velocity is smooth, zero at both ends, and has the peak and the
/// duration of the main sequence. It is symmetrical unless it leans: large real saccades have an
/// early peak.
class SaccadeCourse {
  public:
    /// No way, of duration 0.
    SaccadeCourse() = default;

    /// Amplitude > 0. `vigour` > 0 makes it so many times as fast as the main sequence. A `lean` of
    /// 0 .. 1 has it peak earlier by some .4 of that share of its duration, and slightly higher.
    SaccadeCourse(double amplitude_deg, double vigour, double lean = 0.0);

    [[nodiscard]] double duration_s() const { return duration_s_; }

    /// The share of the way that is done, 0 .. 1; `elapsed_s` >= 0.
    [[nodiscard]] double progress(double elapsed_s) const;

  private:
    double duration_s_ = 0.0;
    double sharpness_ = 0.0;
    double lean_ = 0.0;
};

}  // namespace gazeloop::gaze
