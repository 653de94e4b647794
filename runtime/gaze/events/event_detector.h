#pragma once

#include <cstdint>
#include <glm/gtc/quaternion.hpp>
#include <glm/vec3.hpp>
#include <limits>
#include <optional>

#include "runtime/gaze/events/direction_history.h"
#include "runtime/gaze/events/eye_event.h"

namespace gazeloop::gaze {

/// Says of each sample what the eyes do, while samples pass: causal but for one sample of
/// look-ahead, at any rate from 30 to 1000 Hz, in fixed memory, without allocation.
///
/// - A saccade begins where the gaze departs from its slow movement faster than a threshold that
///   follows the noise. It ends where it is slowest before the lens swings back, or turns round.
/// - The oscillation after it lasts until the gaze has been calm for some milliseconds. Where
///   samples are more than some 12 ms apart, none is told.
/// - Pursuit and fixation are told apart by how fast and how straight the gaze moved in the last
///   200 and 28 ms, gathered over some 165 ms, so that one slow moment changes nothing.
/// - Lost is what has no direction, what is faster or longer than a saccade can be (the begin of
///   a blink), and what follows until the gaze has come to rest.
///
/// The figures were chosen on one half of the persons of Andersson et al. 2017 (Behavior Research
/// Methods 49:616), at 500, 250 and 100 Hz; `./dev bench events` reports the other half.
class EventDetector {
  public:
    struct Parameters {
        /// What takes longer is no saccade, and the gaze counts as lost. An eye takes less.
        std::int64_t longest_saccade_ns = 90'000'000;
        /// A speed is taken over so much of the time, and over three samples at least.
        std::int64_t speed_window_ns = 4'600'000;
    };

    EventDetector() = default;
    explicit EventDetector(const Parameters& parameters) : parameters_(parameters) {}

    /// How the movement began that is going on.
    struct Movement {
        std::int64_t begin_ns = 0;
        glm::dvec3 from{0.0, 0.0, -1.0};  ///< where the gaze was then
        double peak_deg_per_s = 0.0;      ///< of a saccade or its oscillation
    };

    /// The gaze at a time, a unit vector; none: it is lost. A sample whose time is not after that
    /// of the one before is left out. A gap of over 50 ms is a loss.
    void add(std::int64_t time_ns, const std::optional<glm::dvec3>& direction);
    /// All directions are given in another frame from here on: the rotation that takes one of
    /// before into it.
    void turn(const glm::dquat& rotation);

    /// What the eyes did at the sample before the one that was added last; none as long as fewer
    /// than three came.
    [[nodiscard]] std::optional<EyeEvent> event_before() const { return event_before_; }
    /// What they do at the one that was added last, as far as one can tell without the next.
    [[nodiscard]] EyeEvent event() const { return event_; }

    [[nodiscard]] const Movement& movement() const { return movement_; }
    /// What was lately added without a loss between.
    [[nodiscard]] const DirectionHistory& history() const { return history_; }
    /// Of the gaze, as of the last few milliseconds, deg/s; zero where it is lost.
    [[nodiscard]] const glm::dvec3& velocity_deg_per_s() const { return velocity_; }
    /// How long the span is that this is the velocity of, seconds; meaningless where it is lost.
    [[nodiscard]] double velocity_window_s() const { return window_s_; }
    /// Of what the gaze follows: that of the slow movement, deg/s.
    [[nodiscard]] const glm::dvec3& slow_velocity_deg_per_s() const { return slow_; }
    /// Median of the speeds at which the gaze rests: above all the tracker's noise, deg/s.
    [[nodiscard]] double resting_deg_per_s() const { return resting_deg_per_s_; }
    /// A saccade begins where the gaze departs faster than this from its slow movement, deg/s; 0
    /// before the first speed.
    [[nodiscard]] double begin_deg_per_s() const { return begin_deg_per_s_; }

  private:
    void lose(std::int64_t time_ns);
    void rest(std::int64_t time_ns);
    void start_saccade(std::int64_t time_ns, double speed);
    void follow_slowly(double departure);
    void follow_saccade(std::int64_t time_ns, double speed, double departure, double floor);
    void follow_oscillation(std::int64_t time_ns, double speed, double departure, double threshold);
    void follow_loss(std::int64_t time_ns, double speed);
    void weigh_pursuit(std::int64_t time_ns);

    Parameters parameters_;
    DirectionHistory history_;
    std::optional<std::int64_t> last_ns_;
    std::optional<EyeEvent> event_before_;
    EyeEvent event_ = EyeEvent::Fixation;
    EyeEvent slow_event_ = EyeEvent::Fixation;  ///< which of the two slow ones it is
    Movement movement_;
    glm::dvec3 velocity_{0.0};
    glm::dvec3 peak_velocity_{0.0};
    glm::dvec3 slow_{0.0};
    double window_s_ = 0.0;           ///< of velocity_
    std::size_t window_samples_ = 0;  ///< the oldest in it lies so many back
    double speed_before_ = 0.0;
    std::int64_t restless_ns_ = 0;  ///< when it was last not calm, in an oscillation
    double pursuit_ = -0.5;         ///< evidence for it (positive) or against it
    /// When that was gathered last.
    std::int64_t weighed_ns_ = std::numeric_limits<std::int64_t>::min();
    std::uint64_t rested_ = 0;
    double resting_deg_per_s_ = 2.0;
    double begin_deg_per_s_ = 0.0;
};

}  // namespace gazeloop::gaze
