#pragma once

#include <string>
#include <vector>

#include "runtime/settings/setting_row.h"

namespace gazeloop::profiles {

/// The settings profile.*: each a name or a .toml file.
struct ProfileSettings {
    std::string display = "fove0";
    std::string tracker = "generic";
};

[[nodiscard]] std::vector<settings::SettingRow> rows_of(ProfileSettings& profile);

}  // namespace gazeloop::profiles
