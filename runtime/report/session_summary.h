#pragma once

#include <vector>

#include "runtime/display/display_profile.h"
#include "runtime/latency/latency_summary.h"
#include "runtime/session/session_file.h"

namespace gazeloop::report {

/// What a session's meta keeps of its display: all that decides when photons come. What the profile
/// does not know has no entry.
std::vector<NamedValue> meta_of(const display::DisplayProfile& display);

/// The display that a session's meta speaks of, as far as it does. Of 60 Hz where it does not say.
display::DisplayProfile recorded_display(const session::SessionFile& session);

latency::SummaryConfig summary_config(const display::DisplayProfile& display,
                                      latency::LoopClock clock);

/// What a session's meta says of its clock and display.
latency::SummaryConfig summary_config(const session::SessionFile& session);

/// The summary of a recorded session, the same as at the end of its run.
latency::SummaryReport summarize(const session::SessionFile& session);

}  // namespace gazeloop::report
