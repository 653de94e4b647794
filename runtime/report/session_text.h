#pragma once

#include <string>
#include <string_view>

#include "runtime/report/percentiles.h"
#include "runtime/report/session_summary.h"

namespace gazeloop::report {

/// The report of a session for people: that of its run, with exact percentiles, the gaze error in
/// degrees and the worst frames. `lag` (lag_reasons.h) stands above the table. With the default
/// percentiles at most 100 columns wide; every line ended by a newline.
std::string session_text(const SessionSummary& session, const Percentiles& percentiles,
                         std::string_view lag = {});

}  // namespace gazeloop::report
