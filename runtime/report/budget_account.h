#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/latency/budget.h"
#include "runtime/latency/monitor_snapshot.h"

namespace gazeloop::report {

/// What a run has made of its budget, by its last snapshot: each limited part with the frames above
/// its limit and the longest run of them. At most 100 columns wide, every line ended by a newline.
std::string budget_account_text(const latency::MonitorSnapshot& last,
                                const latency::LatencyBudget& budget);

/// The same for programs.
nlohmann::ordered_json budget_account_json(const latency::MonitorSnapshot& last,
                                           const latency::LatencyBudget& budget);

}  // namespace gazeloop::report
