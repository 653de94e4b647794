#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>

#include "runtime/governor/level_account.h"
#include "runtime/latency/predicted_latency.h"
#include "runtime/report/lag_reasons.h"
#include "runtime/report/trace_account.h"
#include "runtime/run/frame_run.h"
#include "runtime/run/left_out.h"
#include "runtime/run/run_monitor.h"
#include "runtime/session/replay_check.h"

namespace gazeloop::run {

/// All that is said at the end of a run.
struct RunSummary {
    const latency::SummaryReport& report;
    report::LagReasons reasons;
    latency::PredictionCheck prediction;
    const report::TraceAccount& trace;
    const RunMonitor& monitor;
    LeftOut left_out{};
    const governor::LevelAccount* levels = nullptr;  ///< null: nobody governs it
    const session::ReplayHash* hash = nullptr;       ///< null: not asked for
    const session::ReplayCheck* check = nullptr;     ///< null: no replay of a session
    RunClock clock = RunClock::Wall;
    bool fixed_in_head = false;  ///< the gaze: no tracker
};

/// For people, lines ended by newlines. `quiet`: only what was asked for by name, hash and check.
[[nodiscard]] std::string run_summary_text(const RunSummary& run, bool quiet);

/// For programs.
[[nodiscard]] nlohmann::ordered_json run_summary_json(const RunSummary& run);

}  // namespace gazeloop::run
