#pragma once

#include <cstdint>
#include <optional>

#include "runtime/gaze/gaze_sample.h"
#include "sim/gaze_simulation.h"
#include "sim/person.h"
#include "sim/random.h"
#include "sim/sample_loss.h"

namespace gazeloop::sim {

/// Samples a person as a tracker with the given errors would. Sample k is taken k periods of the
/// tracker's own clock after the start, reported in order, and has sequence number k: gaps are
/// losses. An eye whose lids cover its pupil (openness below .7, assumed) or that is lost is not
/// valid and has confidence 0. All times are Modelled; `sampled` is the true one, whatever the
/// tracker's clock does.
///
/// Errors are turns of the true direction, per eye. Bias: its direction is uniform and its size
/// Rayleigh over seeds, which has a P95 of 2.1 times its median (the Vive Pro Eye's is 2.6 times).
/// The covariance that it states is that of its noise, which is all that such a device knows.
class EyeTracker {
  public:
    EyeTracker(const TrackerTerms& terms, std::uint64_t seed, std::int64_t start_ns);

    /// Takes the next sample; none if it is lost. In the order of arrival. Not once finished().
    [[nodiscard]] std::optional<gaze::GazeSample> step(Person& person);
    /// The same of what the eyes truly do at next_s(). Its head is known where the head moves.
    [[nodiscard]] std::optional<gaze::GazeSample> step(const TrueGaze& truth, bool head_moves);

    /// When the next sample is taken, seconds from the start.
    [[nodiscard]] double next_s() const { return next_s_; }

    /// The next sample does not arrive before this.
    [[nodiscard]] std::int64_t earliest_arrival_ns() const { return earliest_arrival_ns_; }

    /// Whether host time, int64 nanoseconds, has no room for another sample.
    [[nodiscard]] bool finished() const { return finished_; }

  private:
    struct Offset {
        double right_rad = 0.0;
        double up_rad = 0.0;
    };

    void schedule();
    [[nodiscard]] gaze::EyeRay measured(const gaze::EyeRay& truth, std::size_t eye, bool lost);

    TrackerTerms terms_;
    std::int64_t start_ns_;
    std::int64_t delay_ns_;
    std::uint64_t sequence_ = 0;  ///< of the next sample
    double next_s_ = 0.0;         ///< when it is taken, from the start
    std::int64_t next_device_ns_ = 0;
    std::int64_t next_ns_ = 0;  ///< the same in host time
    std::int64_t earliest_arrival_ns_ = 0;
    std::int64_t arrived_before_ns_;
    bool finished_ = false;
    gaze::PerEye<Offset> bias_;
    gaze::PerEye<Random> noise_;
    Random jitter_;
    SampleLoss dropouts_;
    gaze::PerEye<SampleLoss> eye_losses_;
};

}  // namespace gazeloop::sim
