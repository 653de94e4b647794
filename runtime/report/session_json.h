#pragma once

#include <nlohmann/json_fwd.hpp>

#include "runtime/report/percentiles.h"
#include "runtime/report/session_summary.h"
#include "runtime/session/session_info.h"

namespace gazeloop::report {

/// The number in `schema_version` of the JSON; REPORT.md says what it holds.
inline constexpr int kReportSchemaVersion = 1;

/// The report of a session for programs. Its keys and those of summary_json() are the same where
/// they say the same. null: withheld or unknown.
nlohmann::ordered_json session_json(const SessionSummary& session, const session::SessionInfo& info,
                                    const Percentiles& percentiles);

}  // namespace gazeloop::report
