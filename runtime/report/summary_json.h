#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/latency/latency_summary.h"

namespace gazeloop::report {

/// The report for programs: everything that the text says, with units in the keys. null: withheld
/// or unknown.
nlohmann::ordered_json summary_json(const latency::SummaryReport& report);

/// One row of it.
nlohmann::ordered_json row_json(const latency::DurationRow& row);

/// As it is written to a file. Names of files and cells may be in any encoding: what is not UTF-8
/// is replaced.
std::string json_text(const nlohmann::ordered_json& json);

}  // namespace gazeloop::report
