#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/latency/latency_summary.h"

namespace gazeloop::report {

/// What happened in a run that a user should know, each thing with how often and when, seconds from
/// the first frame; at most 100 columns wide. Empty if nothing did.
std::string happenings_text(const latency::SummaryReport& report);

/// The same for programs: a list, empty if nothing happened.
nlohmann::ordered_json happenings_json(const latency::SummaryReport& report);

}  // namespace gazeloop::report
