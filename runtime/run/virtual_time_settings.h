#pragma once

#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::run {

/// The settings virtual_time.*
struct VirtualTimeSettings {
    double gpu_ms = 8.0;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(VirtualTimeSettings& virtual_time);

}  // namespace gazeloop::run
