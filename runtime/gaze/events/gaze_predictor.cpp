#include "runtime/gaze/events/gaze_predictor.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/events/saccade_forecast.h"
#include "runtime/gaze/main_sequence.h"

namespace gazeloop::gaze {
namespace {

// Chosen on the same half of the persons as EventDetector's.
constexpr double kLeastPeak_deg_per_s = 126.0;
constexpr double kLeastTravel_deg = 0.6;
constexpr double kSlowedDown = 0.6;  // of its peak: it may end at any time
// The forecast less so many deviations: always, once it slows down, and shortly ahead.
constexpr double kHeldBack = 0.1;
constexpr double kHeldBackSlowing = 0.28;
constexpr double kHeldBackShort = 1.5;
constexpr double kShort_s = 0.010;
// A person's vigour, from saccades of at least so much.
constexpr double kLearnedFrom_deg = 2.0;
constexpr double kLearned = 0.15;   // share of the difference, per saccade
constexpr double kUsualPeak = 0.9;  // over the main sequence's
constexpr double kLeastVigour = 0.6;
constexpr double kMostVigour = 1.6;
constexpr double kPursuitShare = 0.5;
constexpr double kLeastPursuit_deg_per_s = 6.0;

// Bounds of 95 %: what drift, oscillation and wavering pursuit make, and what the forecast leaves.
constexpr double kRestingError_deg = 0.06;
constexpr double kDrift_deg_per_s = 6.0;
constexpr double kSwing_deg = 0.8;
constexpr double kPursuitError = 0.6;
constexpr double kSaccadeDeviations = 2.0;
constexpr double kSaccadeError = 0.15;  // of the speed

}  // namespace

void GazePredictor::add(std::int64_t time_ns, const std::optional<glm::dvec3>& direction) {
    const EyeEvent before = detector_.event();
    const EventDetector::Movement saccade = detector_.movement();
    detector_.add(time_ns, direction);
    const EyeEvent now = detector_.event();
    if (before != EyeEvent::Saccade || now == before || now == EyeEvent::Lost) {
        return;
    }
    const double amplitude_deg =
        glm::degrees(glm::distance(saccade.from, detector_.history().back(1).direction));
    if (amplitude_deg < kLearnedFrom_deg) {
        return;
    }
    const double ratio =
        saccade.peak_deg_per_s / (kUsualPeak * main_sequence(amplitude_deg).peak_deg_per_s);
    vigour_ = std::clamp(vigour_ * std::exp(kLearned * std::log(ratio / vigour_)), kLeastVigour,
                         kMostVigour);
}

GazePrediction GazePredictor::predict(std::int64_t time_ns) const {
    GazePrediction prediction;
    prediction.event = detector_.event();
    const DirectionHistory& history = detector_.history();
    if (history.size() == 0) {
        return prediction;
    }
    const __int128 ahead_ns = static_cast<__int128>(time_ns) - history.back(0).time_ns;
    prediction.horizon_ns = static_cast<std::int64_t>(
        std::clamp<__int128>(ahead_ns, 0, std::max<std::int64_t>(longest_ns_, 0)));
    const double ahead_s = static_cast<double>(prediction.horizon_ns) * 1e-9;
    const double resting_deg = kRestingError_deg + kDrift_deg_per_s * ahead_s;
    switch (prediction.event) {
        case EyeEvent::Fixation:
            prediction.verdict = PredictionVerdict::Hold;
            prediction.uncertainty_rad = glm::radians(resting_deg);
            break;
        case EyeEvent::Oscillation:
            prediction.verdict = PredictionVerdict::Hold;
            prediction.uncertainty_rad = glm::radians(resting_deg + kSwing_deg);
            break;
        case EyeEvent::Pursuit:
            predict_pursuit(ahead_s, prediction);
            break;
        case EyeEvent::Saccade:
            predict_saccade(ahead_s, prediction);
            break;
        case EyeEvent::Lost:
            break;
    }
    return prediction;
}

void GazePredictor::predict_pursuit(double ahead_s, GazePrediction& prediction) const {
    const glm::dvec3 slow = detector_.slow_velocity_deg_per_s();
    const double speed = glm::length(slow);
    prediction.uncertainty_rad = glm::radians(kRestingError_deg + kDrift_deg_per_s * ahead_s +
                                              kPursuitError * speed * ahead_s);
    if (!(speed > kLeastPursuit_deg_per_s)) {
        prediction.verdict = PredictionVerdict::Hold;
        return;
    }
    const glm::dvec3 now = detector_.history().back(0).direction;
    const auto then = unit(now + glm::radians(kPursuitShare * ahead_s) * slow);
    if (then) {
        prediction.verdict = PredictionVerdict::Extrapolated;
        prediction.turn = glm::dquat(now, *then);
    }
}

void GazePredictor::predict_saccade(double ahead_s, GazePrediction& prediction) const {
    const DirectionHistory& history = detector_.history();
    const EventDetector::Movement& movement = detector_.movement();
    const glm::dvec3 now = history.back(0).direction;
    const glm::dvec3 way = now - movement.from;
    const double speed = glm::length(detector_.velocity_deg_per_s());
    const SaccadeInFlight seen{
        .travelled_deg = glm::degrees(glm::length(way)),
        .elapsed_s = static_cast<double>(history.back(0).time_ns - movement.begin_ns) * 1e-9,
        .speed_deg_per_s = speed,
        .peak_deg_per_s = movement.peak_deg_per_s,
        .speed_age_s = 0.5 * detector_.velocity_window_s(),
        .vigour = vigour_};
    const SaccadeTravel travel = forecast(seen, ahead_s);
    const double vigour = speed / movement.peak_deg_per_s;
    prediction.uncertainty_rad =
        glm::radians(kRestingError_deg + kSaccadeDeviations * travel.sd_deg +
                     std::min(kSaccadeError * speed * ahead_s, travel.further_deg));
    if (movement.peak_deg_per_s < kLeastPeak_deg_per_s || seen.travelled_deg < kLeastTravel_deg ||
        vigour < kSlowedDown) {
        prediction.uncertainty_rad = *prediction.uncertainty_rad + glm::radians(travel.further_deg);
        return;
    }
    const double held_back = kHeldBack + kHeldBackSlowing * (1.0 - vigour) +
                             kHeldBackShort * std::exp(-ahead_s / kShort_s);
    const double further_deg = std::max(travel.further_deg - held_back * travel.sd_deg, 0.0);
    const auto then =
        unit(now + way / glm::length(way) * glm::radians(further_deg));  // travelled: not zero
    if (then) {
        prediction.verdict = PredictionVerdict::Extrapolated;
        prediction.turn = glm::dquat(now, *then);
    }
}

}  // namespace gazeloop::gaze
