#pragma once

#include <string>
#include <string_view>

#include "runtime/latency/latency_summary.h"

namespace gazeloop::report {

/// The report for people, at most 100 columns wide, every line ended by a newline. If the run was
/// not real time, the first line says so. The next line says how eye-to-photon was obtained. `lag`
/// (lag_reasons.h) follows, above the table.
std::string summary_text(const latency::SummaryReport& report, std::string_view lag = {});

// Its parts, for other texts of the same.

/// The first two lines.
std::string summary_head(const latency::SummaryReport& report);
/// Below the table: what its ages do not know of the display.
std::string summary_notes(const latency::SummaryReport& report);
/// Frames, gaze, samples, and what happened.
std::string summary_counts(const latency::SummaryReport& report);

}  // namespace gazeloop::report
