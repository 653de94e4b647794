#pragma once

#include <vector>

#include "runtime/report/page/table.h"
#include "runtime/trade/equal_quality.h"
#include "runtime/trade/part_worth.h"
#include "runtime/trade/setting_fit.h"
#include "runtime/trade/sweep_rows.h"

namespace gazeloop::trade {

// The tables of a sweep's page. Points that failed are in none of them.

/// Cells and all figures, dearest point first.
[[nodiscard]] report::page::Table cells_table(const std::vector<SweepRow>& rows);
/// Times and the first figure, slowest point first.
[[nodiscard]] report::page::Table time_table(const std::vector<SweepRow>& rows);
/// Each pass of the points on a front.
[[nodiscard]] report::page::Table pass_table(const std::vector<SweepRow>& rows);
[[nodiscard]] report::page::Table equal_table(const EqualQuality& equal);
/// What one changed setting does, change by change.
[[nodiscard]] report::page::Table worth_table(const MethodWorth& worth);
[[nodiscard]] report::page::Table fits_table(const std::vector<MethodFit>& fits);
/// What each figure means.
[[nodiscard]] report::page::Table figure_table(const std::vector<SweepRow>& rows);
/// Those that are not built in.
[[nodiscard]] report::page::Table settings_table(const SweepSubject& subject);

}  // namespace gazeloop::trade
