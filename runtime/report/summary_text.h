#pragma once

#include <string>

#include "runtime/latency/latency_summary.h"

namespace gazeloop::report {

/// The report for people, at most 100 columns wide, every line ended by a newline. If the run was
/// not real time, the first line says so. The next line says how eye-to-photon was obtained.
std::string summary_text(const latency::SummaryReport& report);

}  // namespace gazeloop::report
