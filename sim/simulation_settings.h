#pragma once

#include <vector>

#include "runtime/settings/setting_row.h"
#include "sim/gaze_simulation.h"

namespace gazeloop::sim {

/// The settings sim.*: the seed and every term.
[[nodiscard]] std::vector<settings::SettingRow> rows_of(GazeSimulation& simulation);

}  // namespace gazeloop::sim
