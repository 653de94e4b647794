#pragma once

#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::run {

/// The settings monitor.*
struct MonitorSettings {
    double window_s = 5.0;
    double interval_s = 1.0;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(MonitorSettings& monitor);

}  // namespace gazeloop::run
