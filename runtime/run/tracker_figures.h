#pragma once

#include <span>

#include "runtime/latency/predicted_latency.h"
#include "runtime/named_value.h"
#include "runtime/report/lag_facts.h"

namespace gazeloop::run {

/// What is known of the tracker of a run with these settings: a simulated one's from sim.*, fixed
/// gaze is there whenever it is asked for, and all others' from the profile profile.tracker. What
/// the settings or the profile do not state is unknown, all of it where the profile is not there
/// (any more).
[[nodiscard]] latency::TrackerFigures tracker_figures(std::span<const NamedValue> settings,
                                                      report::GazeOrigin origin);

}  // namespace gazeloop::run
