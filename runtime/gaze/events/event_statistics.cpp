#include "runtime/gaze/events/event_statistics.h"

#include <algorithm>
#include <cmath>

#include "runtime/gaze/direction.h"
#include "runtime/gaze/gaze_quality.h"
#include "runtime/memory/long_vector.h"

namespace gazeloop::gaze {
namespace {

constexpr double kLeastSaccade_deg = 2.0;

std::optional<Spread> spread_of(memory::LongVector<double> values) {
    if (values.empty()) {
        return std::nullopt;
    }
    std::ranges::sort(values);
    const auto at = [&](double share) {
        return values[static_cast<std::size_t>(
            std::llround(share * static_cast<double>(values.size() - 1)))];
    };
    return Spread{at(0.05), at(0.5), at(0.95)};
}

/// Gathers one kind's events.
struct Kind {
    std::size_t count = 0;
    double all_ms = 0.0;
    memory::LongVector<double> durations_ms;  ///< of those that are not cut

    [[nodiscard]] EventKindStatistics over(double recording_ms) const {
        EventKindStatistics statistics{.count = count};
        if (recording_ms > 0.0) {
            statistics.per_minute = static_cast<double>(count) * 60e3 / recording_ms;
            statistics.percent = 100.0 * all_ms / recording_ms;
        }
        statistics.duration_ms = spread_of(durations_ms);
        return statistics;
    }
};

}  // namespace

bool is_as_long_as_a_blink(const RecordedEvent& event) {
    const double unseen_ms = static_cast<double>(event.unseen_ns) * 1e-6;
    return event.event == EyeEvent::Lost && unseen_ms >= kShortestBlink_ms &&
           unseen_ms <= kLongestBlink_ms;
}

bool is_on_the_main_sequence(const RecordedEvent& event) {
    const glm::dvec3 nowhere{0.0};
    return event.event == EyeEvent::Saccade && event.from != nowhere && event.to != nowhere &&
           event.amplitude_deg >= kLeastSaccade_deg;
}

EventStatistics event_statistics(std::span<const RecordedEvent> events) {
    EventStatistics statistics;
    if (events.empty()) {
        return statistics;
    }
    const double all_ms =
        static_cast<double>(events.back().end_ns - events.front().begin_ns) * 1e-6;
    statistics.duration_s = all_ms * 1e-3;
    Kind fixations;
    Kind saccades;
    Kind oscillations;
    Kind pursuits;
    Kind blinks;
    Kind losses;
    memory::LongVector<double> deviations_deg;
    memory::LongVector<double> amplitudes_deg;
    memory::LongVector<double> peaks_deg_per_s;
    memory::LongVector<double> pursued_deg_per_s;
    memory::LongVector<SaccadePoint> points;
    for (const RecordedEvent& event : events) {
        const bool blink = is_as_long_as_a_blink(event);
        Kind& kind = event.event == EyeEvent::Fixation      ? fixations
                     : event.event == EyeEvent::Saccade     ? saccades
                     : event.event == EyeEvent::Oscillation ? oscillations
                     : event.event == EyeEvent::Pursuit     ? pursuits
                     : blink                                ? blinks
                                                            : losses;
        // Of a loss, how long the eye was not there; what settles afterwards is no gaze either.
        const double whole_ms = event.duration_ms();
        ++kind.count;
        kind.all_ms += whole_ms;
        if (&event == &events.front() || &event == &events.back()) {
            continue;
        }
        if (event.event == EyeEvent::Saccade && whole_ms <= 0.0) {
            ++statistics.instant_saccades;
            continue;
        }
        kind.durations_ms.push_back(
            event.unseen_ns > 0 ? static_cast<double>(event.unseen_ns) * 1e-6 : whole_ms);
        if (event.event == EyeEvent::Fixation) {
            deviations_deg.push_back(event.deviation_deg);
        } else if (event.event == EyeEvent::Saccade) {
            amplitudes_deg.push_back(event.amplitude_deg);
            peaks_deg_per_s.push_back(event.peak_deg_per_s);
            if (is_on_the_main_sequence(event)) {
                points.push_back({event.amplitude_deg, event.peak_deg_per_s, whole_ms});
            }
        } else if (event.event == EyeEvent::Pursuit && whole_ms > 0.0) {
            pursued_deg_per_s.push_back(event.amplitude_deg / (1e-3 * whole_ms));
        }
    }
    statistics.fixations = fixations.over(all_ms);
    statistics.saccades = saccades.over(all_ms);
    statistics.oscillations = oscillations.over(all_ms);
    statistics.pursuits = pursuits.over(all_ms);
    statistics.blinks = blinks.over(all_ms);
    statistics.losses = losses.over(all_ms);
    statistics.fixation_deviation_deg = spread_of(std::move(deviations_deg));
    statistics.saccade_amplitude_deg = spread_of(std::move(amplitudes_deg));
    statistics.saccade_peak_deg_per_s = spread_of(std::move(peaks_deg_per_s));
    statistics.pursuit_deg_per_s = spread_of(std::move(pursued_deg_per_s));
    statistics.main_sequence = fit_main_sequence(points);
    return statistics;
}

}  // namespace gazeloop::gaze
