#pragma once

#include <string>
#include <vector>

#include "drivers/trace/read_options.h"
#include "runtime/settings/setting_row.h"

namespace gazeloop::drivers {

/// The settings trace.*
struct TraceSettings {
    std::string axes = "none";
    bool accept_repairs = false;
    double longest_gap_s = 10.0;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(TraceSettings& trace);

/// With the format "auto".
[[nodiscard]] ReadOptions read_options(const TraceSettings& trace);

}  // namespace gazeloop::drivers
