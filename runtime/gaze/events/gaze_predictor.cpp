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
// Up to twice as far as the eye goes is no worse than to hold: no further than twice what is
// travelled but for so many deviations, at kNear_s and less, and at twice that and more.
constexpr double kUnsure = 0.5;
constexpr double kUnsureFar = 1.0;
constexpr double kNear_s = 0.020;
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

constexpr double kLandingDeviations = 2.0;
constexpr double kLeastDeviation_deg = 0.02;  // trackers without noise

}  // namespace

void GazePredictor::add(std::int64_t time_ns, const std::optional<glm::dvec3>& direction) {
    const EyeEvent before = detector_.event();
    const EventDetector::Movement saccade = detector_.movement();
    detector_.add(time_ns, direction);
    const EyeEvent now = detector_.event();
    if (now == EyeEvent::Saccade) {
        saccade_ = saccade_as_seen();
    }
    check_.follow(detector_);
    if (now != EyeEvent::Lost && detector_.history().size() > 0 && check_.asks(time_ns)) {
        std::array<PredictionCheck::Forecast, PredictionCheck::kHorizons_ns.size()> forecasts;
        for (std::size_t i = 0; i < forecasts.size(); ++i) {
            forecasts[i] =
                forecast_at(static_cast<double>(PredictionCheck::kHorizons_ns[i]) * 1e-9);
        }
        check_.remember(time_ns, forecasts);
    }
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

SaccadeForecast GazePredictor::saccade_as_seen() const {
    const DirectionHistory& history = detector_.history();
    const EventDetector::Movement& movement = detector_.movement();
    return SaccadeForecast(
        {.travelled_deg = glm::degrees(glm::length(history.back(0).direction - movement.from)),
         .elapsed_s = static_cast<double>(history.back(0).time_ns - movement.begin_ns) * 1e-9,
         .speed_deg_per_s = glm::length(detector_.velocity_deg_per_s()),
         .peak_deg_per_s = movement.peak_deg_per_s,
         .speed_age_s = 0.5 * detector_.velocity_window_s(),
         .vigour = vigour_});
}

PredictionCheck::Forecast GazePredictor::forecast_at(double ahead_s) const {
    const glm::dvec3 now = detector_.history().back(0).direction;
    const double resting_deg = kRestingError_deg + kDrift_deg_per_s * ahead_s;
    PredictionCheck::Forecast forecast{.event = detector_.event(),
                                       .from = now,
                                       .to = now,
                                       .uncertainty_rad = glm::radians(resting_deg)};
    switch (forecast.event) {
        case EyeEvent::Oscillation:
            forecast.uncertainty_rad = glm::radians(resting_deg + kSwing_deg);
            break;
        case EyeEvent::Pursuit:
            forecast_pursuit(ahead_s, forecast);
            break;
        case EyeEvent::Saccade:
            forecast_saccade(ahead_s, forecast);
            break;
        case EyeEvent::Fixation:
        case EyeEvent::Lost:
            break;
    }
    return forecast;
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
    if (prediction.event == EyeEvent::Lost) {
        return prediction;
    }
    const PredictionCheck::Forecast forecast =
        forecast_at(static_cast<double>(prediction.horizon_ns) * 1e-9);
    prediction.uncertainty_rad =
        forecast.uncertainty_rad * check_.widening(forecast.event, prediction.horizon_ns);
    const double share = check_.share(forecast.event, prediction.horizon_ns);
    if (forecast.to != forecast.from && share > 0.0) {
        if (const auto to = unit(forecast.from + share * (forecast.to - forecast.from))) {
            prediction.verdict = PredictionVerdict::Extrapolated;
            prediction.turn = glm::dquat(forecast.from, *to);
        }
    } else if (prediction.event != EyeEvent::Saccade) {
        prediction.verdict = PredictionVerdict::Hold;
    }
    return prediction;
}

SeenMotion GazePredictor::seen() const {
    const DirectionHistory& history = detector_.history();
    SeenMotion seen{.event = detector_.event()};
    if (history.size() < 3) {
        return seen;
    }
    const std::int64_t since_ns = history.back(0).time_ns - detector_.movement().begin_ns;
    seen.since_s = std::max(static_cast<double>(since_ns) * 1e-9, 0.0);
    const glm::dvec3 before = 0.5 * (history.back(1).direction + history.back(2).direction);
    // The median length of a speed is that of two normal values; a speed over a window is of two
    // positions.
    constexpr double kMedianOfSpeed = 1.665;
    const double sd_deg =
        std::max(detector_.resting_deg_per_s() * detector_.velocity_window_s() / kMedianOfSpeed,
                 kLeastDeviation_deg);
    seen.departure = glm::degrees(glm::distance(history.back(0).direction, before)) / sd_deg;
    if (seen.event == EyeEvent::Saccade) {
        const SaccadeLanding landing = saccade_.landing();
        seen.flies_on_s = std::max(landing.in_s - kLandingDeviations * landing.sd_s, 0.0);
    }
    return seen;
}

void GazePredictor::forecast_pursuit(double ahead_s, PredictionCheck::Forecast& forecast) const {
    const glm::dvec3 slow = detector_.slow_velocity_deg_per_s();
    const double speed = glm::length(slow);
    forecast.uncertainty_rad += glm::radians(kPursuitError * speed * ahead_s);
    if (speed > kLeastPursuit_deg_per_s) {
        forecast.to = unit(forecast.from + glm::radians(kPursuitShare * ahead_s) * slow)
                          .value_or(forecast.from);
    }
}

void GazePredictor::forecast_saccade(double ahead_s, PredictionCheck::Forecast& forecast) const {
    const EventDetector::Movement& movement = detector_.movement();
    const glm::dvec3 now = forecast.from;
    const glm::dvec3 way = now - movement.from;
    const double travelled_deg = glm::degrees(glm::length(way));
    const double speed = glm::length(detector_.velocity_deg_per_s());
    const SaccadeTravel travel = saccade_.after(ahead_s);
    const double vigour = speed / movement.peak_deg_per_s;
    forecast.uncertainty_rad =
        glm::radians(kRestingError_deg + kSaccadeDeviations * travel.sd_deg +
                     std::min(kSaccadeError * speed * ahead_s, travel.further_deg));
    if (movement.peak_deg_per_s < kLeastPeak_deg_per_s || travelled_deg < kLeastTravel_deg ||
        vigour < kSlowedDown) {
        forecast.uncertainty_rad += glm::radians(travel.further_deg);
        return;
    }
    const double held_back = kHeldBack + kHeldBackSlowing * (1.0 - vigour) +
                             kHeldBackShort * std::exp(-ahead_s / kShort_s);
    const double unsure =
        std::lerp(kUnsure, kUnsureFar, std::clamp((ahead_s - kNear_s) / kNear_s, 0.0, 1.0));
    const double further_deg =
        std::max(std::min(travel.further_deg - held_back * travel.sd_deg,
                          2.0 * (travel.further_deg - unsure * travel.sd_deg)),
                 0.0);
    forecast.to = unit(now + way / glm::length(way) * glm::radians(further_deg))
                      .value_or(now);  // travelled: not zero
}

}  // namespace gazeloop::gaze
