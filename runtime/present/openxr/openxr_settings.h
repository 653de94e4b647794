#pragma once

#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::present {

/// The settings openxr.*
struct OpenXrSettings {
    /// For how long a runtime may go without a display time that is one, before its session counts
    /// as lost.
    double patience_s = 2.0;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(OpenXrSettings& openxr);

}  // namespace gazeloop::present
