#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "runtime/report/budget_gate.h"
#include "runtime/report/comparison.h"
#include "runtime/report/lag_reasons.h"
#include "runtime/report/page/report_page.h"
#include "runtime/report/prediction_text.h"

namespace gazeloop::report::page {

/// The paragraph, then each question with its answer.
[[nodiscard]] std::vector<std::string> why_of(const LagReasons& reasons);

/// Each limited part, measured against allowed.
[[nodiscard]] PageSection section_of(const BudgetGate& gate);

/// What the parts allow, with the measured distribution beside it.
[[nodiscard]] PageSection section_of(const PredictionTable& prediction);

/// What a terminal shows of something, blank lines at both ends left out.
[[nodiscard]] PageSection section_of_lines(std::string id, std::string title,
                                           std::string_view lines);

/// What changed since the session `before`, with the interval of each change.
[[nodiscard]] PageSection section_of(const Comparison& comparison, const Percentiles& percentiles,
                                     const std::string& before);

}  // namespace gazeloop::report::page
