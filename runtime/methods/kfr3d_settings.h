#pragma once

#include <cstdint>
#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::methods {

/// The settings kfr3d.*; the map is that of kfr.*, whose sigma is the foveal region's.
struct Kfr3dSettings {
    std::int64_t regions = 3;
    double inner = 0.4;
    double growth = 1.5;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(Kfr3dSettings& kfr3d);

}  // namespace gazeloop::methods
