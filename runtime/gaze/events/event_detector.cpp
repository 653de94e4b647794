#include "runtime/gaze/events/event_detector.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace gazeloop::gaze {
namespace {

constexpr double kNsPerMs = 1e6;
constexpr std::int64_t ms(double milliseconds) {
    return static_cast<std::int64_t>(milliseconds * kNsPerMs);
}

constexpr std::size_t kFewest = 3;  // samples that a speed is taken of
constexpr std::int64_t kGap_ns = ms(50.0);

// A saccade begins at the greater of the two, deg/s and multiples of the resting speed. Slow
// trackers show short saccades slowly: no more is asked of them than this amplitude in one window.
constexpr double kBegin_deg_per_s = 36.0;
constexpr double kBeginOverRest = 7.0;
constexpr double kLeastAmplitude_deg = 1.3;

// Below one of the three it may end: at its slowest, or where it turns.
constexpr double kEnd_deg_per_s = 30.0;
constexpr double kEndOverRest = 5.3;
constexpr double kEndOverPeak = 0.23;
constexpr double kStill_deg_per_s = 5.0;  // and at once below these
constexpr double kStillOverRest = 0.8;
constexpr std::int64_t kShortest_ns = ms(5.2);
constexpr double kFastest_deg_per_s = 1100.0;

constexpr double kSwingingPeak_deg_per_s = 40.0;  // slower saccades have no oscillation
constexpr double kSwingingWindow_s = 0.025;       // nor has what is seen so coarsely
constexpr double kRestless_deg_per_s = 19.0;
constexpr double kRestlessOverRest = 3.0;
constexpr std::int64_t kCalm_ns = ms(4.2);
constexpr std::int64_t kLongestSwing_ns = ms(32.0);
constexpr std::int64_t kNoSaccade_ns = ms(4.0);  // after a saccade's end
constexpr double kNextOverPeak = 1.15;           // another one out of an oscillation

constexpr std::int64_t kAfterLoss_ns = ms(22.0);
constexpr double kFoundAgain_deg_per_s = 45.0;
constexpr std::int64_t kLongestAfterLoss_ns = ms(190.0);

constexpr double kSlow_ms = 40.0;  // time constant of the slow movement
constexpr double kLeastGain = 0.015;
constexpr double kLeastRest_deg_per_s = 0.3;

// Pursuit. The evidence is log speed over a threshold in both windows, each within bounds, and how
// straight the longer way was (its length over that of four parts).
constexpr std::int64_t kPursuit_ns = ms(200.0);
constexpr std::int64_t kPursuitAtLeast_ns = ms(70.0);
constexpr std::int64_t kPursuitShort_ns = ms(28.0);
constexpr std::size_t kPursuitShortSamples = 2;
constexpr double kPursuit_deg_per_s = 0.65;
constexpr double kPursuitOverRest = 0.92;  // times the root of the speed's window over 29 ms: the
constexpr double kPursuitRest_s = 0.029;   // noise of trackers is between white and drifting
constexpr double kPursuitMost = 2.0;
constexpr double kPursuitLeast = -0.83;
constexpr double kPursuitShortWeight = 2.6;
constexpr double kStraightWeight = 1.5;
constexpr double kStraight = 0.61;
constexpr std::size_t kStraightParts = 4;
constexpr double kPursuitGathered_ms = 165.0;
constexpr double kPursuitTold = 0.65;
constexpr std::int64_t kPursuitStep_ns = ms(1.9);  // no more often: it is gathered over long

double log_speed(double speed, double threshold) {
    constexpr double kLeast_deg_per_s = 1e-3;
    return std::clamp(std::log(std::max(speed, kLeast_deg_per_s) / threshold), kPursuitLeast,
                      kPursuitMost);
}

}  // namespace

void EventDetector::lose(std::int64_t time_ns) {
    event_ = EyeEvent::Lost;
    movement_ = {.begin_ns = time_ns, .from = movement_.from};
}

void EventDetector::rest(std::int64_t time_ns) {
    event_ = slow_event_;
    movement_ = {.begin_ns = time_ns, .from = history_.back(1).direction};
    if (slow_event_ == EyeEvent::Fixation) {
        slow_ = glm::dvec3{0.0};
    }
}

void EventDetector::start_saccade(std::int64_t time_ns, double speed) {
    event_ = EyeEvent::Saccade;
    movement_ = {.begin_ns = time_ns,
                 .from = history_.back(window_samples_).direction,
                 .peak_deg_per_s = speed};
    peak_velocity_ = velocity_;
}

void EventDetector::turn(const glm::dquat& rotation) {
    history_.turn(rotation);
    movement_.from = rotation * movement_.from;
    velocity_ = rotation * velocity_;
    peak_velocity_ = rotation * peak_velocity_;
    slow_ = rotation * slow_;
}

void EventDetector::add(std::int64_t time_ns, const std::optional<glm::dvec3>& direction) {
    if (last_ns_ && time_ns <= *last_ns_) {
        return;
    }
    const bool after_gap = last_ns_ && static_cast<__int128>(time_ns) - *last_ns_ > kGap_ns;
    if (!last_ns_) {
        movement_.begin_ns = time_ns;
    } else if (!direction || after_gap) {
        event_before_ = event_;
    }
    last_ns_ = time_ns;
    if (!direction || after_gap) {
        history_.clear();
        velocity_ = glm::dvec3{0.0};
        lose(time_ns);
    }
    if (!direction) {
        return;
    }
    history_.add(time_ns, *direction);
    if (history_.size() < kFewest) {
        if (event_before_ && !after_gap) {
            event_before_ = event_;
        }
        return;
    }
    window_samples_ = std::max(history_.oldest_within(0, parameters_.speed_window_ns), kFewest - 1);
    velocity_ = history_.velocity_deg_per_s(window_samples_);
    window_s_ = history_.elapsed_s(window_samples_, 0);
    const double speed = glm::length(velocity_);
    const double departure = glm::length(velocity_ - slow_);
    const double floor = std::min(kBegin_deg_per_s, kLeastAmplitude_deg / window_s_);
    const double threshold = std::max(floor, kBeginOverRest * resting_deg_per_s_);
    begin_deg_per_s_ = threshold;
    const std::int64_t middle_ns = history_.back(1).time_ns;
    switch (event_) {
        case EyeEvent::Lost:
            follow_loss(middle_ns, speed);
            break;
        case EyeEvent::Fixation:
        case EyeEvent::Pursuit:
            if (departure > threshold) {
                start_saccade(middle_ns, speed);
            } else {
                follow_slowly(departure);
                weigh_pursuit(middle_ns);
            }
            break;
        case EyeEvent::Saccade:
            follow_saccade(middle_ns, speed, departure, floor);
            break;
        case EyeEvent::Oscillation:
            follow_oscillation(middle_ns, speed, departure, threshold);
            break;
    }
    speed_before_ = speed;
    event_before_ = event_;
}

void EventDetector::follow_loss(std::int64_t time_ns, double speed) {
    const std::int64_t since_ns = time_ns - movement_.begin_ns;
    if ((speed < kFoundAgain_deg_per_s && since_ns > kAfterLoss_ns) ||
        since_ns > kLongestAfterLoss_ns) {
        slow_event_ = EyeEvent::Fixation;
        rest(time_ns);
    }
}

/// The resting speed is one step of a running median (Ma, Muthukrishnan and Sandler 2013, "Frugal
/// streaming").
void EventDetector::follow_slowly(double departure) {
    ++rested_;
    const double gain = std::max(1.0 / static_cast<double>(rested_ + 1), kLeastGain);
    resting_deg_per_s_ = std::max(
        resting_deg_per_s_ * (departure > resting_deg_per_s_ ? 1.0 + gain : 1.0 / (1.0 + gain)),
        kLeastRest_deg_per_s);
    const double elapsed_ms = 1e3 * history_.elapsed_s(1, 0);
    slow_ += elapsed_ms / (kSlow_ms + elapsed_ms) * (velocity_ - slow_);
}

void EventDetector::weigh_pursuit(std::int64_t time_ns) {
    const std::int64_t since_ns = time_ns - movement_.begin_ns;
    const std::int64_t step_ns = time_ns - std::max(weighed_ns_, movement_.begin_ns);
    if (since_ns >= kPursuitAtLeast_ns && step_ns >= kPursuitStep_ns) {
        weighed_ns_ = time_ns;
        const std::size_t oldest = history_.oldest_within(1, std::min(since_ns, kPursuit_ns));
        const std::size_t lately = std::min(
            std::max(history_.oldest_within(1, kPursuitShort_ns), kPursuitShortSamples + 1),
            oldest);
        if (oldest >= kStraightParts) {
            const auto way_deg = [this](std::size_t older, std::size_t newer) {
                return glm::degrees(
                    glm::distance(history_.back(older).direction, history_.back(newer).direction));
            };
            const double threshold = kPursuit_deg_per_s + kPursuitOverRest * resting_deg_per_s_ *
                                                              std::sqrt(window_s_ / kPursuitRest_s);
            const double net_deg = way_deg(oldest, 1);
            double path_deg = 0.0;
            std::size_t newer = 1;
            for (std::size_t part = 1; part <= kStraightParts; ++part) {
                const std::size_t older = 1 + (oldest - 1) * part / kStraightParts;
                path_deg += way_deg(older, newer);
                newer = older;
            }
            const double straight = path_deg > 0.0 ? net_deg / path_deg : 0.0;
            const double evidence =
                log_speed(net_deg / history_.elapsed_s(oldest, 1), threshold) +
                kPursuitShortWeight *
                    log_speed(way_deg(lately, 1) / history_.elapsed_s(lately, 1), threshold) +
                kStraightWeight * (straight - kStraight);
            const double elapsed_ms =
                std::min(static_cast<double>(step_ns) / kNsPerMs, 2e3 * history_.elapsed_s(1, 0));
            pursuit_ += elapsed_ms / (kPursuitGathered_ms + elapsed_ms) * (evidence - pursuit_);
            if (pursuit_ > kPursuitTold) {
                slow_event_ = EyeEvent::Pursuit;
            } else if (pursuit_ < -kPursuitTold) {
                slow_event_ = EyeEvent::Fixation;
            }
        }
    }
    event_ = slow_event_;
}

void EventDetector::follow_saccade(std::int64_t time_ns, double speed, double departure,
                                   double floor) {
    if (speed > movement_.peak_deg_per_s) {
        movement_.peak_deg_per_s = speed;
        peak_velocity_ = velocity_;
    }
    const std::int64_t since_ns = time_ns - movement_.begin_ns;
    if (movement_.peak_deg_per_s > kFastest_deg_per_s ||
        since_ns > parameters_.longest_saccade_ns) {
        lose(time_ns);
        return;
    }
    const double slow =
        std::max({kEnd_deg_per_s * floor / kBegin_deg_per_s, kEndOverRest * resting_deg_per_s_,
                  kEndOverPeak * movement_.peak_deg_per_s});
    const double still = std::max(kStill_deg_per_s, kStillOverRest * resting_deg_per_s_);
    const bool at_slowest = speed > speed_before_ || glm::dot(velocity_, peak_velocity_) < 0.0;
    const bool ends = (speed < slow && at_slowest) || std::min(speed, departure) < still;
    if (!ends || since_ns < kShortest_ns) {
        return;
    }
    if (movement_.peak_deg_per_s > kSwingingPeak_deg_per_s && window_s_ < kSwingingWindow_s) {
        event_ = EyeEvent::Oscillation;
        movement_.begin_ns = time_ns;
        movement_.from = history_.back(1).direction;
        restless_ns_ = time_ns;
    } else {
        rest(time_ns);
    }
}

void EventDetector::follow_oscillation(std::int64_t time_ns, double speed, double departure,
                                       double threshold) {
    const std::int64_t since_ns = time_ns - movement_.begin_ns;
    if (since_ns > kNoSaccade_ns &&
        departure > std::max(threshold, kNextOverPeak * movement_.peak_deg_per_s)) {
        start_saccade(time_ns, speed);
        return;
    }
    if (speed > std::max(kRestless_deg_per_s, kRestlessOverRest * resting_deg_per_s_)) {
        restless_ns_ = time_ns;
    }
    if (time_ns - restless_ns_ >= kCalm_ns || since_ns > kLongestSwing_ns) {
        rest(time_ns);
    }
}

}  // namespace gazeloop::gaze
