#pragma once

#include <string>
#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::run {

/// The settings target.*
struct TargetSettings {
    std::string name = "openxr";
    bool validation = false;
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(TargetSettings& target);

}  // namespace gazeloop::run
