#include "runtime/gaze/events/prediction_check.h"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

namespace gazeloop::gaze {
namespace {
constexpr double kForgets = 100.0;  // forecasts
// What a source is trusted with before anything is known of it: as if a pursuit of this speed had
// been forecast rightly.
constexpr double kTrusted_rad_per_s = 0.175;  // 10 deg/s
constexpr double kLearned = 0.03;             // of the logarithm, per forecast
constexpr double kMissed = 0.05;
constexpr double kLeastWidening = 0.5;
constexpr double kMostWidening = 30.0;  // trackers with a degree of noise
/// By event: what the same persons needed on whom the bounds were chosen.
constexpr std::array kFirstWidening{1.3, 1.1, 1.0, 1.1};  // fixation, saccade, oscillation, pursuit

/// Between two points of the history.
glm::dvec3 at_time(const DirectionHistory::Point& earlier, const DirectionHistory::Point& later,
                   std::int64_t time_ns) {
    const double part = static_cast<double>(time_ns - earlier.time_ns) /
                        static_cast<double>(later.time_ns - earlier.time_ns);
    return earlier.direction + part * (later.direction - earlier.direction);
}

}  // namespace

std::array<std::array<PredictionCheck::Record, PredictionCheck::kHorizons_ns.size()>,
           PredictionCheck::kKinds>
PredictionCheck::first_records() {
    std::array<std::array<Record, kHorizons_ns.size()>, kKinds> records{};
    for (std::size_t kind = 0; kind < kKinds; ++kind) {
        for (Record& record : records[kind]) {
            record.widening = kFirstWidening[kind];
        }
    }
    return records;
}

std::size_t PredictionCheck::horizon_of(std::int64_t ahead_ns) {
    std::size_t nearest = 0;
    for (std::size_t i = 1; i < kHorizons_ns.size(); ++i) {
        if (2 * ahead_ns > kHorizons_ns[i - 1] + kHorizons_ns[i]) {
            nearest = i;
        }
    }
    return nearest;
}

void PredictionCheck::remember(std::int64_t time_ns,
                               const std::array<Forecast, kHorizons_ns.size()>& forecasts) {
    asked_ns_ = time_ns;
    ring_[remembered_ % kMost] = {time_ns, forecasts};
    ++remembered_;
    for (std::uint64_t& judged : judged_) {
        judged = std::max(judged, remembered_ > kMost ? remembered_ - kMost : 0);
    }
}

void PredictionCheck::turn(const glm::dquat& rotation) {
    for (Remembered& remembered : ring_) {
        for (Forecast& forecast : remembered.forecasts) {
            forecast.from = rotation * forecast.from;
            forecast.to = rotation * forecast.to;
        }
    }
}

void PredictionCheck::follow(const EventDetector& detector) {
    const DirectionHistory& history = detector.history();
    const EyeEvent event = detector.event();
    if (history.size() < 2 || event == EyeEvent::Lost) {
        judged_.fill(remembered_);
        before_ = event;
        return;
    }
    if (event == EyeEvent::Saccade && before_ != EyeEvent::Saccade) {
        saccade_began_ns_ = detector.movement().begin_ns;
    }
    before_ = event;
    const std::int64_t now_ns = history.back(0).time_ns;
    for (std::size_t horizon = 0; horizon < kHorizons_ns.size(); ++horizon) {
        std::uint64_t& judged = judged_[horizon];
        while (judged < remembered_ &&
               now_ns - ring_[judged % kMost].made_ns >= kHorizons_ns[horizon] + kNoticed_ns) {
            judge(detector, ring_[judged % kMost], horizon);
            ++judged;
        }
    }
}

void PredictionCheck::judge(const EventDetector& detector, const Remembered& remembered,
                            std::size_t horizon) {
    const DirectionHistory& history = detector.history();
    const Forecast& forecast = remembered.forecasts[horizon];
    const std::int64_t due_ns = remembered.made_ns + kHorizons_ns[horizon];
    const std::size_t after = history.oldest_within(0, history.back(0).time_ns - due_ns);
    if (after + 1 >= history.size()) {
        return;  // the gaze was lost between
    }
    if (saccade_began_ns_ >= remembered.made_ns) {
        return;  // nobody could foresee it
    }
    const glm::dvec3 real =
        at_time(history.back(after + 1), history.back(after), due_ns) - forecast.from;
    const glm::dvec3 told = forecast.to - forecast.from;
    Record& record = records_[kind_of(forecast.event)][horizon];
    const double believed = share(forecast.event, kHorizons_ns[horizon]);
    const double error_rad = glm::length(believed * told - real);
    const bool missed = error_rad > record.widening * forecast.uncertainty_rad;
    record.widening =
        std::clamp(record.widening * std::exp(kLearned * ((missed ? 1.0 : 0.0) - kMissed)),
                   kLeastWidening, kMostWidening);
    if (forecast.event == EyeEvent::Pursuit) {
        const double kept = 1.0 - 1.0 / kForgets;
        record.with = kept * record.with + glm::dot(told, real);
        record.square = kept * record.square + glm::dot(told, told);
    }
}

double PredictionCheck::share(EyeEvent event, std::int64_t ahead_ns) const {
    if (event != EyeEvent::Pursuit) {
        return 1.0;
    }
    const Record& of = record(event, ahead_ns);
    const double horizon_s = static_cast<double>(kHorizons_ns[horizon_of(ahead_ns)]) * 1e-9;
    const double trusted_rad = horizon_s * kTrusted_rad_per_s;
    const double trust = trusted_rad * trusted_rad;
    return std::clamp((of.with + trust) / (of.square + trust), 0.0, 1.0);
}

double PredictionCheck::widening(EyeEvent event, std::int64_t ahead_ns) const {
    return event == EyeEvent::Lost ? 1.0 : record(event, ahead_ns).widening;
}

}  // namespace gazeloop::gaze
