#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/latency/budget.h"
#include "runtime/latency/monitor_snapshot.h"

namespace gazeloop::report {

// The lines of `--monitor-json`, without their ends: MONITOR.md says what is in them. `dropped`:
// lines before this one that the reader did not get.

/// The first line. `clock`: of the frames' times, "wall" or "virtual".
std::string monitor_begin_json(const std::optional<latency::LatencyBudget>& budget,
                               std::string_view clock);

/// `what`: "interval", or "end" for the last line.
std::string monitor_snapshot_json(std::string_view what, const latency::MonitorSnapshot& snapshot,
                                  std::uint64_t dropped);

std::string monitor_event_json(const time::Stamp& time, std::string_view kind,
                               std::string_view text, std::uint64_t dropped);

}  // namespace gazeloop::report
