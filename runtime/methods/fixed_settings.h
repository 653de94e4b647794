#pragma once

#include <string>
#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::methods {

/// The settings fixed.*
struct FixedSettings {
    std::string method = "kfr";
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(FixedSettings& fixed);

}  // namespace gazeloop::methods
