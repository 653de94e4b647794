#pragma once

#include <nlohmann/json_fwd.hpp>
#include <optional>
#include <string>

#include "runtime/governor/level_account.h"
#include "runtime/latency/budget.h"
#include "runtime/probe/comparison.h"
#include "runtime/report/budget_gate.h"
#include "runtime/report/comparison.h"
#include "runtime/report/lag_reasons.h"
#include "runtime/report/page/event_line.h"
#include "runtime/report/percentiles.h"
#include "runtime/report/session_summary.h"

namespace gazeloop::session_report {

/// What another session's figures became in this one, with that session's name.
struct Against {
    report::Comparison comparison;
    std::string before;
};

/// All that is said of a session.
struct SessionReport {
    const session::SessionInfo& info;
    report::Percentiles percentiles{};
    std::optional<latency::LatencyBudget> budget{};
    report::page::EventLine events{};
    std::optional<governor::LevelAccount> levels{};  ///< of a governed run
    report::SessionSummary summary{};
    latency::PredictionCheck prediction{};
    report::LagReasons reasons{};
    std::optional<report::BudgetGate> gate{};
    std::optional<Against> against{};
    std::optional<probe::Comparison> measured{};
};

/// For people; the budget's verdict and the comparison are the end of it.
[[nodiscard]] std::string text_of(const SessionReport& made);
/// For programs.
[[nodiscard]] nlohmann::ordered_json json_of(const SessionReport& made);
/// One page of HTML. `file`: the session's, as the page calls it.
[[nodiscard]] std::string page_of(const SessionReport& made, const std::string& file);

}  // namespace gazeloop::session_report
