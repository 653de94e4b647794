#pragma once

#include "runtime/latency/latency_summary.h"
#include "runtime/session/session_file.h"

namespace gazeloop::cli {

/// What a session's meta says of its clock and display.
latency::SummaryConfig summary_config(const session::SessionFile& session);

/// The summary of a recorded session, the same as at the end of its run.
latency::SummaryReport summarize(const session::SessionFile& session);

}  // namespace gazeloop::cli
