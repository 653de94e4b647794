#pragma once

#include <nlohmann/json_fwd.hpp>

#include "runtime/latency/latency_summary.h"

namespace gazeloop::report {

/// The report for programs: everything that the text says, with units in the keys. null: withheld
/// or unknown.
nlohmann::ordered_json summary_json(const latency::SummaryReport& report);

}  // namespace gazeloop::report
