#pragma once

#include <cstddef>
#include <optional>
#include <span>

#include "runtime/gaze/events/recorded_events.h"
#include "runtime/gaze/main_sequence_fit.h"

namespace gazeloop::gaze {

/// How a quantity is spread.
struct Spread {
    double p05 = 0.0;
    double median = 0.0;
    double p95 = 0.0;
};

/// What all events of a kind have in common.
struct EventKindStatistics {
    std::size_t count = 0;
    double per_minute = 0.0;              ///< of the recording's time
    double percent = 0.0;                 ///< of the recording's time
    std::optional<Spread> duration_ms{};  ///< none: there is no such event
};

/// What the eyes of a recording did. Events at its very begin and end are cut, and are in no
/// spread.
struct EventStatistics {
    double duration_s = 0.0;  ///< of all events
    EventKindStatistics fixations;
    EventKindStatistics saccades;
    EventKindStatistics oscillations;
    EventKindStatistics pursuits;
    EventKindStatistics blinks;  ///< losses in which the eye is unseen for 100 to 400 ms
    EventKindStatistics losses;  ///< all others
    std::optional<Spread> fixation_deviation_deg;
    /// Between one sample and the next, so that neither size nor duration is known: left out of
    /// the spreads, as a recording's first and last event are.
    std::size_t instant_saccades = 0;
    std::optional<Spread> saccade_amplitude_deg;
    std::optional<Spread> saccade_peak_deg_per_s;
    std::optional<Spread> pursuit_deg_per_s;       ///< amplitude over duration
    std::optional<MainSequenceFit> main_sequence;  ///< none: too few saccades, or all alike
};

/// Whether a loss lasts as long as blinks do.
[[nodiscard]] bool is_as_long_as_a_blink(const RecordedEvent& event);

/// Whether the whole saccade was seen: gaze before and after it, and 2 deg or more, where noise
/// changes its peak velocity little.
[[nodiscard]] bool is_on_the_main_sequence(const RecordedEvent& event);

[[nodiscard]] EventStatistics event_statistics(std::span<const RecordedEvent> events);

}  // namespace gazeloop::gaze
