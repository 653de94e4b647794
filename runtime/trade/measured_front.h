#pragma once

#include "runtime/error.h"
#include "runtime/governor/front.h"
#include "runtime/trade/sweep_report.h"

namespace gazeloop::trade {

/// The points of a sweep that no other one beats in both time and the first figure, as a governor
/// moves along them: the best first, thinned to governor::kMostLevels so that neighbours differ by
/// equal ratios of time where the points allow. Times are those of full resolution over each
/// point's speed-up. Errors (Usage): no point has figures, or the first figure is one of which
/// higher is better.
Expected<governor::Front> measured_front(const SweepReport& report);

/// How a front was measured: command line, display, sizes, device.
[[nodiscard]] std::string front_source(const SweepReport& report);

}  // namespace gazeloop::trade
