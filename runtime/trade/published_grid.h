#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/trade/sweep_rows.h"

namespace gazeloop::trade {

/// The parameters that Meng et al. (2018) looked at: the pilot study's grid (sigma 1.0 to 3.6 by
/// .2, alpha 1 to 4), and alpha 5 and 6 of their Figure 4 at the sigma that they chose.
[[nodiscard]] std::vector<SweepPoint> published_grid();

/// What they chose, since at least 80 % of the answers then were "identical".
[[nodiscard]] SweepPoint published_choice();

/// Where the first figure stands at the published choice, and for each alpha of the grid that was
/// measured the sigmas up to which it is no worse than there; for people, a line each. Empty: the
/// choice was not measured, or nothing beside it.
[[nodiscard]] std::vector<std::string> against_published(const std::vector<SweepRow>& rows);

}  // namespace gazeloop::trade
