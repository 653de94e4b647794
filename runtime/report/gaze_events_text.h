#pragma once

#include <array>
#include <nlohmann/json_fwd.hpp>
#include <span>
#include <string>
#include <string_view>
#include <utility>

#include "runtime/gaze/events/event_statistics.h"

namespace gazeloop::report {

/// The kinds of events, by the names that users read, in the order in which they are told.
[[nodiscard]] std::array<std::pair<std::string_view, const gaze::EventKindStatistics*>, 6> kinds_of(
    const gaze::EventStatistics& statistics);

/// Rows on what the eyes did.
[[nodiscard]] std::string events_text(const gaze::EventStatistics& statistics);

/// The same for programs, units in the keys; null for what is unknown.
[[nodiscard]] nlohmann::ordered_json events_json(const gaze::EventStatistics& statistics);

/// A line for each event under a header, times since the recording's first sample. Empty cells:
/// not of this kind of event, or unknown.
[[nodiscard]] std::string events_csv(std::span<const gaze::RecordedEvent> events,
                                     std::int64_t first_ns);

}  // namespace gazeloop::report
