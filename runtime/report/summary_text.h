#pragma once

#include <string>

#include "runtime/latency/latency_summary.h"

namespace gazeloop::report {

/// The report for people, at most 100 columns wide, every line ended by a newline. The first line
/// says that the run was not real time, where it was not; the next how eye-to-photon was obtained.
std::string summary_text(const latency::SummaryReport& report);

}  // namespace gazeloop::report
