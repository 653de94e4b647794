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

// Chosen on the persons that EventDetector's were chosen on and on eight more of the same data set,
// at 500, 250 and 125 Hz, and on simulated ones at 120 Hz.
constexpr double kLeastTravel_deg = 0.23;
constexpr double kSlowedDown = 0.56;  // of its peak: it may end at any time
constexpr double kNewest = 0.39;      // of that speed, the newest step's share
constexpr double kLeastStep_s = 1.9e-3;
// The forecast less so many deviations: near and far ahead (by_horizon),
constexpr double kHeldBack = 0.30;
constexpr double kHeldBackFar = 1.11;
// once it slows down, and shortly ahead: for so long, and longer where samples are farther apart
// than 2 ms.
constexpr double kHeldBackSlowing = 0.61;
constexpr double kHeldBackShort = 2.8;
constexpr double kShort_s = 0.0106;
constexpr double kShortPerStep = 0.64;
// Up to twice as far as the eye goes is no worse than to hold: so many times as far as it goes at
// least.
constexpr double kMostOverLeast = 2.8;
// A person's vigour, from saccades of at least so much.
constexpr double kLearnedFrom_deg = 2.0;
constexpr double kLearned = 0.15;   // share of the difference, per saccade
constexpr double kUsualPeak = 0.9;  // over the main sequence's
constexpr double kLeastVigour = 0.6;
constexpr double kMostVigour = 1.6;
constexpr double kPursuitShare = 0.46;
constexpr double kLeastPursuit_deg_per_s = 4.3;

// Bounds of 95 %: what drift, oscillation and wavering pursuit make, and what the forecast leaves.
constexpr double kRestingError_deg = 0.06;
constexpr double kDrift_deg_per_s = 6.0;
constexpr double kSwing_deg = 0.8;
constexpr double kPursuitError = 0.6;
constexpr double kSaccadeDeviations = 1.4;
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
        in_flight_ = saccade_as_seen();
        saccade_ = SaccadeForecast(in_flight_);
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

SaccadeInFlight GazePredictor::saccade_as_seen() const {
    const DirectionHistory& history = detector_.history();
    const EventDetector::Movement& movement = detector_.movement();
    const double speed = glm::length(detector_.velocity_deg_per_s());
    std::size_t before = 1;
    while (before + 1 < history.size() && history.elapsed_s(before, 0) < kLeastStep_s) {
        ++before;
    }
    const double step_s = history.elapsed_s(before, 0);
    const glm::dvec3 step = history.back(0).direction - history.back(before).direction;
    const double along = speed > 0.0 ? glm::dot(step, detector_.velocity_deg_per_s()) / speed : 0.0;
    return {.travelled_deg = glm::degrees(glm::length(history.back(0).direction - movement.from)),
            .elapsed_s = static_cast<double>(history.back(0).time_ns - movement.begin_ns) * 1e-9,
            .speed_deg_per_s = speed,
            .peak_deg_per_s = movement.peak_deg_per_s,
            .speed_age_s = 0.5 * detector_.velocity_window_s(),
            .step_deg_per_s = glm::degrees(along) / step_s,
            .step_age_s = 0.5 * step_s,
            .noise_deg_per_s = detector_.resting_deg_per_s(),
            .vigour = vigour_};
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
    const glm::dvec3 now = forecast.from;
    const glm::dvec3 way = now - detector_.movement().from;
    const double speed = in_flight_.speed_deg_per_s;
    const double peak = in_flight_.peak_deg_per_s;
    const SaccadeTravel travel = saccade_.after(ahead_s);
    forecast.uncertainty_rad =
        glm::radians(kRestingError_deg + kSaccadeDeviations * travel.sd_deg +
                     std::min(kSaccadeError * speed * ahead_s, travel.further_deg));
    const double fast =
        std::clamp(std::lerp(speed, in_flight_.step_deg_per_s, kNewest) / peak, 0.0, 1.0);
    if (in_flight_.travelled_deg < kLeastTravel_deg || fast < kSlowedDown) {
        forecast.uncertainty_rad += glm::radians(travel.further_deg);
        return;
    }
    const double between_s = std::max(2.0 * in_flight_.step_age_s - 2e-3, 0.0);
    const double held_back =
        by_horizon(ahead_s, kHeldBack, kHeldBackFar) + kHeldBackSlowing * (1.0 - fast) +
        kHeldBackShort * std::exp(-ahead_s / (kShort_s + kShortPerStep * between_s));
    const double further_deg = std::clamp(travel.further_deg - held_back * travel.sd_deg, 0.0,
                                          kMostOverLeast * travel.at_least_deg);
    forecast.to = unit(now + way / glm::length(way) * glm::radians(further_deg))
                      .value_or(now);  // travelled: not zero
}

}  // namespace gazeloop::gaze
